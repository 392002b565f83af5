"""Compiles sources as this build does, and makes modules that sus can load."""
import json
import os
import pathlib
import re
import shlex
import subprocess

from sus import ROOT, SUS

BUILD = pathlib.Path(SUS).parent


def compile_command(exchange=None):
    """How this build compiles heat, less its in- and output; include paths below ROOT become those below `exchange`."""
    entries = json.loads((BUILD / "compile_commands.json").read_text())
    command = next(e["command"] for e in entries
                   if "tushar_heat_objects.dir/Unity" in e["file"] or e["file"].endswith("components/heat/heat.cpp"))
    words = shlex.split(command)
    words = [word for word in words[:words.index("-o")] if "ccache" not in word]
    words = words[max(k for k, word in enumerate(words) if word.endswith(("c++", "g++"))):]
    return [word.replace(str(ROOT), str(exchange)) if exchange and word.startswith("-I") else word for word in words]


def run(command, folder=None, **environment):
    """What a command gives."""
    return subprocess.run([str(word) for word in command], cwd=folder, capture_output=True, text=True,
                          env=dict(os.environ, **environment))


def must(command, folder=None):
    """Runs a command that must work."""
    done = run(command, folder)
    if done.returncode != 0:
        raise AssertionError(f"{shlex.join(map(str, command))}\n{done.stdout}{done.stderr}")


def interface():
    """The hash of the headers of this build."""
    header = (BUILD / "generated/core/simulation/module_interface.hpp").read_text()
    return re.search(r'TUSHAR_INTERFACE "(\w+)"', header)[1]


def card(name):
    """The source that tushar_module() makes for a module of that name."""
    text = (ROOT / "tools/lib/module_card.cpp.in").read_text()
    return text.replace("@TUSHAR_MODULE@", name).replace("@TUSHAR_INTERFACE@", interface())


def flags_of_links():
    """Of compilation, those that linking needs, too."""
    return [word for word in compile_command() if word.startswith(("-fsanitize", "-O"))]


def link_module(file, *objects):
    """A shared library that stands on the core of this build."""
    must(["g++", *flags_of_links(), "-shared", "-o", file, *objects, BUILD / "libtushar_core.so"])


def link_program(file, *objects):
    """A program that stands on the core of this build."""
    must(["g++", *flags_of_links(), "-o", file, *objects, BUILD / "libtushar_core.so", f"-Wl,-rpath,{BUILD}",
          "-lgtest_main", "-lgtest", "-lfmt", "-lpugixml"])
