"""The studies of tools/study and tools/stability: runs, measurements and figures.

It needs the scenes of this repository, so it is not installed."""
