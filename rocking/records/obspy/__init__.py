"""What goes through obspy: its traces and streams, inventories, workspaces, the plug-in that gives it our formats."""
