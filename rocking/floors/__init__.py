"""Floors: what a support makes of the motion of the ground."""
