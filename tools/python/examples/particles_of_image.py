#!/usr/bin/env python3
"""Writes the particles of a body that fills the solid voxels of an image, for the shape <file> of a scene.

    python3 particles_of_image.py foam.pts                              a gyroid, as in ups/solid/crushed_foam.ups
    python3 particles_of_image.py bone.pts --image scan.npy --voxel 2e-5 --threshold 900
    python3 particles_of_image.py bone.pts --image scan.npy --voxel 2e-5 --threshold 900 --gray

An image is a NumPy array of gray values, one for each voxel along x, y, z, from any reader of tomograms. Voxels
brighter than the threshold become particles. With --gray, each line also has the gray value, for <var>p.color</var>:
models such as UCNHVar make stiffness a function of it.
"""
import argparse

import numpy


def gyroid(count=16):
    """One period of a gyroid, positive in its solid half, by Schoen (NASA TN D-5541, 1970)."""
    x, y, z = numpy.meshgrid(*[2 * numpy.pi * (numpy.arange(count) + .5) / count] * 3, indexing="ij")
    return numpy.sin(x) * numpy.cos(y) + numpy.sin(y) * numpy.cos(z) + numpy.sin(z) * numpy.cos(x)


def particles(image, voxel, threshold):
    """Centres [m] and gray values of the voxels above the threshold; the image begins at the origin."""
    solid = numpy.argwhere(image > threshold)
    return (solid + .5) * voxel, image[tuple(solid.T)]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("file", help="file of particles to write")
    parser.add_argument("--image", metavar="FILE.npy", help="gray values of the voxels (by default a gyroid)")
    parser.add_argument("--voxel", type=float, default=.0005, metavar="H", help="width of a voxel [m] (.0005)")
    parser.add_argument("--threshold", type=float, default=0, metavar="T", help="brighter voxels are solid (0)")
    parser.add_argument("--gray", action="store_true", help="write the gray value of each particle, too")
    options = parser.parse_args()
    image = numpy.load(options.image) if options.image else gyroid()
    places, gray = particles(image, options.voxel, options.threshold)
    columns = [places, gray[:, None]] if options.gray else [places]
    numpy.savetxt(options.file, numpy.hstack(columns), fmt="%.9g")
    print(f"{len(places)} particles in {options.file}")


if __name__ == "__main__":
    main()
