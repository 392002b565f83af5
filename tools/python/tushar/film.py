"""Films of all outputs, and pictures that are updated during a run."""
from __future__ import annotations

import contextlib
import fcntl
import itertools
import os
import pathlib
import shutil
import subprocess
import tempfile
import time
from typing import Any, Callable, Dict, Iterator, List, Optional, Sequence, Tuple

import numpy as np

from tushar.archive import Archive
from tushar.errors import ArchiveError
from tushar.figure import Figure, choose
from tushar.view import Output, Quantity, Range, View

SECONDS = 6.0  # a film takes so long, but for few outputs
ALMOST_WHITE = 248  # what choosing 256 colours makes of white
Progress = Callable[[int, int], None]  # of pictures: how many are drawn, of how many
FASTEST, SLOWEST = 25.0, 2.0  # pictures per second


def common_ranges(archive: Archive, variables: Sequence[str], view: View) -> Tuple[List[str], Dict[str, Range]]:
    """The labels drawn for every output, and the range of their values over all outputs."""
    if not archive.times:
        raise ArchiveError(f"'{archive.folder}' has no outputs yet")
    with archive[-1] as last:
        labels = list(variables) or choose(Output(last, view))[0]
    found: Dict[str, List[float]] = {}
    for snapshot in archive:
        with snapshot:
            output = Output(snapshot, view)
            for quantity in (Quantity.of(archive, label) for label in labels):
                try:
                    values = output.values_of(quantity)
                except ArchiveError:  # a start lacks what a step computes
                    continue
                values = values[np.isfinite(values) & ((values > 0) | (not view.log))]
                found.setdefault(quantity.label, []).extend([values.min(), values.max()] if len(values) else [])
    if not any(found.values()) and not view.log:
        raise ArchiveError(f"'{archive.folder}' contains no values of {', '.join(labels)}" +
                           (" in the slice" if view.slices else ""))
    return labels, {label: _round(min(values), max(values), view) for label, values in found.items() if values}


def _planes(archive: Archive, label: str, view: View) -> Optional[Tuple[float, float, float]]:
    """The positions of three slices for all pictures, taken from the middle output; None in fewer dimensions."""
    with archive[len(archive) // 2] as snapshot:
        output = Output(snapshot, view)
        return output.planes(Quantity.of(archive, label)) if len(output.axes) == 3 else None


def _round(low: float, high: float, view: View) -> Range:
    """For a difference, extends a range to be symmetric about 0."""
    most = max(abs(low), abs(high))
    return (-most, most) if view.other and low < 0 else (float(low), float(high))


def figures(archive: Archive, variables: Sequence[str], title: Optional[str], view: View) -> Iterator[Figure]:
    """A figure for each output that contains the drawn variables, all with the same ranges."""
    labels, ranges = common_ranges(archive, variables, view)
    shown = view.with_ranges(ranges).with_planes(_planes(archive, labels[0], view))
    drawn = 0
    for index in range(len(archive)):
        try:
            yield Figure(archive, index, labels, title, shown)
            drawn += 1
        except ArchiveError as error:
            if index or len(archive) == 1:
                raise
            first = error
    if not drawn:
        raise first


def check_path(path: str) -> str:
    """The extension of a film's name; raises ArchiveError for other extensions, or if the folder does not exist."""
    ending = pathlib.Path(path).suffix.lower()
    if ending not in (".gif", ".mp4"):
        raise ArchiveError(f"'{path}' is not a film: its name must end in .mp4 or .gif")
    if not pathlib.Path(path).parent.is_dir():
        raise ArchiveError(f"'{path}': there is no folder '{pathlib.Path(path).parent}'")
    return ending


def write(archive: Archive, path: str, variables: Sequence[str] = (), title: Optional[str] = None,
          view: Optional[View] = None, progress: Optional[Progress] = None) -> Tuple[str, List[str]]:
    """Writes a film, .gif or .mp4 (.gif if ffmpeg is not installed); returns its path, and notes. Calls `progress`
    after each picture."""
    ending = check_path(path)
    notes: List[str] = []
    program = ffmpeg() if ending == ".mp4" else None
    if ending == ".mp4" and not program:
        path = str(pathlib.Path(path).with_suffix(".gif"))
        notes.append("ffmpeg, which writes .mp4, is not installed: the film is a .gif")
    rate = float(np.clip(len(archive) / SECONDS, SLOWEST, FASTEST))
    pictures = _pictures(archive, figures(archive, variables, title, view or View()), notes, progress)
    if program:
        _write_mp4(program, pictures, rate, path)
    else:
        _write_gif(pictures, rate, path)
    return path, notes


def _pictures(archive: Archive, drawn: Iterator[Figure], notes: List[str],
              progress: Optional[Progress]) -> Iterator[Any]:
    """The pictures one by one, as bytes; adds remarks on the pictures to `notes`."""
    for figure in drawn:
        notes += [note for note in figure.notes if note not in notes]
        if progress:
            progress(figure.output.snapshot.index + 1, len(archive))
        yield figure.pixels()


def ffmpeg() -> Optional[str]:
    """The path of the program ffmpeg, or of the one in the package imageio-ffmpeg; None if neither is installed."""
    found = shutil.which("ffmpeg")
    if found:
        return found
    try:
        import imageio_ffmpeg
    except ImportError:
        return None
    return str(imageio_ffmpeg.get_ffmpeg_exe())


def _write_mp4(program: str, pictures: Iterator[Any], rate: float, path: str) -> None:
    first = next(pictures)
    height, width = first.shape[:2]
    given = ["-f", "rawvideo", "-pix_fmt", "rgb24", "-s", f"{width}x{height}", "-r", f"{rate:g}", "-i", "-"]
    wanted = ["-c:v", "libx264", "-crf", "18", "-pix_fmt", "yuv420p", "-movflags", "+faststart", path]
    command = [program, "-y", "-loglevel", "error", *given, *wanted]
    with tempfile.TemporaryFile() as said:
        with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.DEVNULL, stderr=said) as process:
            assert process.stdin
            with contextlib.suppress(BrokenPipeError):  # what it died of is told below
                for picture in itertools.chain([first], pictures):
                    process.stdin.write(picture.tobytes())
                process.stdin.close()
        if process.returncode:
            said.seek(0)
            raise ArchiveError(f"ffmpeg could not write '{path}': {said.read().decode(errors='replace').strip()}")


def _write_gif(pictures: Iterator[Any], rate: float, path: str) -> None:
    """Writes a GIF. All frames use the colours of the first, which includes the colour bar."""
    from PIL import Image
    first = Image.fromarray(next(pictures)).quantize(256, dither=Image.Dither.NONE)
    colours = np.array(first.getpalette()).reshape(-1, 3)
    colours[colours.min(axis=1) >= ALMOST_WHITE] = 255
    first.putpalette(colours.ravel().tolist())
    more = [Image.fromarray(picture).quantize(palette=first, dither=Image.Dither.NONE) for picture in pictures]
    first.save(path, save_all=True, append_images=more, duration=round(1000 / rate), loop=0)


def is_written(folder: str) -> bool:
    """Whether a run is still writing to an archive: a run locks the folder until it ends."""
    try:
        descriptor = os.open(folder, os.O_RDONLY)
    except OSError:
        return False
    try:
        fcntl.flock(descriptor, fcntl.LOCK_SH | fcntl.LOCK_NB)
        return False
    except OSError:
        return True
    finally:
        os.close(descriptor)


def follow(archive: Archive, draw: Callable[[], None], every: float = 0.5) -> None:
    """Calls `draw` at once and after each new output, until the run that writes the archive has ended."""
    drawn = 0
    while True:
        alive = is_written(archive.folder)
        archive.reload()
        if len(archive) > drawn:
            draw()
            drawn = len(archive)
        elif not alive:
            break
        else:
            time.sleep(every)
    if not drawn:
        raise ArchiveError(f"'{archive.folder}' has no outputs, and no run is writing to it")
