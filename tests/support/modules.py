"""Compiles sources with this build's flags, and makes modules that sus can load."""
import json
import os
import pathlib
import re
import shlex
import subprocess

from sus import ROOT, SUS

BUILD = pathlib.Path(SUS).parent


def compile_command(exchange=None):
    """Returns this build's compile command without files; include paths below ROOT become those below `exchange`."""
    entries = json.loads((BUILD / "compile_commands.json").read_text())
    command = next(e["command"] for e in entries
                   if "tushar_heat_objects.dir/Unity" in e["file"] or e["file"].endswith("components/heat/heat.cpp"))
    words = shlex.split(command)
    words = [word for word in words[:words.index("-o")] if "ccache" not in word]
    words = words[max(k for k, word in enumerate(words) if word.endswith(("c++", "g++"))):]
    return [word.replace(str(ROOT), str(exchange)) if exchange and word.startswith("-I") else word for word in words]


def run(command, folder=None, **environment):
    """Runs a command and returns its result."""
    return subprocess.run([str(word) for word in command], cwd=folder, capture_output=True, text=True,
                          env=dict(os.environ, **environment))


def must(command, folder=None):
    """Runs a command that must succeed."""
    done = run(command, folder)
    if done.returncode != 0:
        raise AssertionError(f"{shlex.join(map(str, command))}\n{done.stdout}{done.stderr}")


def interface():
    """Returns the hash of the headers of this build."""
    header = (BUILD / "generated/core/simulation/module_interface.hpp").read_text()
    return re.search(r'TUSHAR_INTERFACE "(\w+)"', header)[1]


def card(name):
    """Returns the source that tushar_module() generates for a module of that name."""
    text = (ROOT / "tools/lib/module_card.cpp.in").read_text()
    return text.replace("@TUSHAR_MODULE@", name).replace("@TUSHAR_INTERFACE@", interface())


def flags_of_links():
    """Returns the compile flags that linking also needs."""
    return [word for word in compile_command() if word.startswith(("-fsanitize", "-O"))]


def link_module(file, *objects):
    """Links a shared library with the core of this build."""
    must(["g++", *flags_of_links(), "-shared", "-o", file, *objects, BUILD / "libtushar_core.so"])


def link_program(file, *objects):
    """Links a program with the core of this build."""
    must(["g++", *flags_of_links(), "-o", file, *objects, BUILD / "libtushar_core.so", f"-Wl,-rpath,{BUILD}",
          "-lgtest_main", "-lgtest", "-lfmt", "-lpugixml"])
