"""Figures in millimetres of paper: lines, areas, letters and axes that become SVG, and nothing else.

The figures of a record's report are many and small. In a plotting library their ticks and legends alone cost most of a
second of CPU for every record; here they cost some hundredths. The figures over a whole study are drawn by matplotlib.
"""
