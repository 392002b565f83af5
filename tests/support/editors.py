"""Validates scenes by the schemas that sus writes, with xmllint (Debian: libxml2-utils)."""
import pathlib
import re
import shutil
import subprocess
import tempfile
import xml.etree.ElementTree as ElementTree

from sus import SUS

XMLLINT = shutil.which("xmllint")


def schema(language):
    """The schema that `sus --schema` prints."""
    return subprocess.run([SUS, "--schema", language], capture_output=True, text=True, check=True).stdout


def invalid(schema_text, language, files):
    """Those of the files that are not valid, as strings. Raises RuntimeError for a schema that xmllint cannot read."""
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder, "schema." + language)
        path.write_text(schema_text)
        command = [XMLLINT, "--noout", "--relaxng" if language == "rng" else "--schema", path, *files]
        said = subprocess.run(command, capture_output=True, text=True).stderr
    valid = {line[:-len(" validates")] for line in said.splitlines() if line.endswith(" validates")}
    if "failed to compile" in said or "Schemas parser error" in said:
        raise RuntimeError(said)
    return sorted({str(file) for file in files} - valid)


def outside_brackets(text, wanted):
    """Places of a character where no square bracket is open."""
    depth, found = 0, []
    for place, letter in enumerate(text):
        depth += (letter == "[") - (letter == "]")
        if letter == wanted and depth == 0:
            found.append(place)
    return found


def follow(node, step):
    """The child that a step such as `Face[2]` names, made where there is none."""
    name, number = re.fullmatch(r"([^\[]+)(?:\[(\d+)\])?", step).groups()
    found = node.findall(name)
    place = int(number or 1) - 1
    return found[place] if place < len(found) else ElementTree.SubElement(node, name)


def overridden(text, *changes):
    """A scene with changes as --set takes them, PATH=VALUE; the steps of a path are names with numbers."""
    root = ElementTree.fromstring(text.encode())
    for change in changes:
        equals = outside_brackets(change, "=")[0]
        node, value = root, change[equals + 1:]
        for step in change[:equals].split("/"):
            if step.startswith("@"):
                node.set(step[1:], value)
                break
            node = follow(node, step)
        else:
            node.text = value
    return ElementTree.tostring(root, encoding="unicode")
