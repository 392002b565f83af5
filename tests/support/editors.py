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
    """Returns the schema that `sus --schema` prints."""
    return subprocess.run([SUS, "--schema", language], capture_output=True, text=True, check=True).stdout


def invalid(schema_text, language, files):
    """Returns the invalid files as strings. Raises RuntimeError for a schema that xmllint cannot read."""
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
    """Returns the positions of a character outside square brackets."""
    depth, found = 0, []
    for place, letter in enumerate(text):
        depth += (letter == "[") - (letter == "]")
        if letter == wanted and depth == 0:
            found.append(place)
    return found


def follow(node, step):
    """Returns the child for a step such as `Face[2]`; creates it if it does not exist."""
    name, number = re.fullmatch(r"([^\[]+)(?:\[(\d+)\])?", step).groups()
    found = node.findall(name)
    place = int(number or 1) - 1
    return found[place] if place < len(found) else ElementTree.SubElement(node, name)


def overridden(text, *changes):
    """Applies changes as in --set, PATH=VALUE, to a scene; the steps of a path are names with indices."""
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
