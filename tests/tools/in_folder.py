"""Test cases whose tests share a temporary folder."""
import pathlib
import tempfile
import unittest


class InFolder(unittest.TestCase):
    """`folder` exists before the first test of the class and is removed after the last."""

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
