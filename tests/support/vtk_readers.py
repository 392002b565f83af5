"""VTK's readers of VTKHDF, h5py and numpy, for tests of viewer files; MISSING names what is not installed."""
import sys

from sus import ROOT

sys.path.insert(0, str(ROOT / "tools/python"))
from tushar.interpreter import ensure

MISSING = None
try:
    ensure("h5py", "numpy", "vtkmodules.vtkIOXdmf2", "vtkmodules.vtkIOHDF")
    import h5py
    import numpy as np
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline as Pipeline
    from vtkmodules.vtkIOHDF import vtkHDFReader
except SystemExit:
    MISSING = "no Python here has h5py and a VTK that reads XDMF and VTKHDF: pip install vtk h5py"
    h5py = np = vtk_to_numpy = Pipeline = vtkHDFReader = None
