"""What tools/study and tools/stability run, measure and draw. It needs this repository's scenes, so it is not installed."""
