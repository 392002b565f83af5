"""What tools/study and tools/stability run, measure and draw.

It needs the scenes of this repository, so it is not installed."""
