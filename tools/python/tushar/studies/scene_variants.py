"""Scenes of the gallery for other methods: the same grid, gas and bodies, with the paper's method or finite volumes."""
import copy
import xml.etree.ElementTree as xml

from tushar.program import scene_path


def read(scene):
    return xml.parse(scene_path(scene)).getroot()


def write(root, path):
    xml.indent(root)
    path.write_text(xml.tostring(root, encoding="unicode") + "\n")


def cells_of(root):
    return [int(count) for count in root.find("Grid/Level/Box/resolution").text.strip(" []").split(",")]


def override(root, text):
    """Applies an override like --set PATH=VALUE of sus, if each tag of the path occurs at most once."""
    path, value = text.split("=", 1)
    element = root
    for tag in path.split("/"):
        found = element.find(tag)
        element = xml.SubElement(element, tag) if found is None else found
    element.text = value


def save(root, *labels):
    """Makes the scene save no fields, but save these totals in every step."""
    archiver = root.find("DataArchiver")
    for tag in ("outputInterval", "outputTimestepInterval", "outputInitTimestep", "outputLastTimestep", "checkpoint",
                "save"):
        for element in archiver.findall(tag):
            archiver.remove(element)
    for label in labels:
        xml.SubElement(archiver, "save", label=label)


def paper(root, particles=4):
    """Selects the paper's method with C = 2, 1 and a number of particles per cell along each axis, unless the scene
    already uses it."""
    section = root.find("MPM")
    if section.find("gas_dynamics") is not None:
        return
    section.remove(section.find("conserving_gas_dynamics"))
    viscosity = xml.SubElement(xml.SubElement(section, "gas_dynamics"), "artificial_viscosity")
    xml.SubElement(viscosity, "quadratic").text = "2"
    xml.SubElement(viscosity, "linear").text = "1"
    each = "[" + ",".join(str(particles) if count > 1 else "1" for count in cells_of(root)) + "]"
    for body in root.iter("geom_object"):
        body.find("res").text = each


def finite_volumes(root):
    """Selects MUSCL-Hancock. Where the scene leaves vacuum there is a gas of 1e-9 times the least density and
    pressure."""
    root.find("SimulationComponent").set("type", "euler")
    model = root.find("MaterialProperties/MPM/material/constitutive_model")
    bodies = root.findall("MaterialProperties/MPM/material/geom_object")
    euler = xml.Element("Euler")
    gas = xml.SubElement(euler, "gas", type=model.get("type"))
    for tag in ("gamma", "p_infinity"):
        if model.find(tag) is not None:
            xml.SubElement(gas, tag).text = model.find(tag).text
    euler.append(_thin_gas(root, bodies))
    for body in bodies:
        body = copy.deepcopy(body)
        for tag in ("res", "placement", "seed"):
            for element in body.findall(tag):
                body.remove(element)
        euler.append(body)
    place = list(root).index(root.find("MPM"))
    root.remove(root.find("MPM"))
    root.remove(root.find("MaterialProperties"))
    root.insert(place, euler)
    for kept in root.iterfind("DataArchiver/save"):
        kept.set("label", kept.get("label").replace("p.", "c.", 1))


def _thin_gas(root, bodies):
    """A body of thin gas that fills the box."""
    body = xml.Element("geom_object")
    box = xml.SubElement(body, "box", label="thin gas")
    for tag, corner in (("min", "lower"), ("max", "upper")):
        xml.SubElement(box, tag).text = root.find(f"Grid/Level/Box/{corner}").text
    for tag in ("density", "pressure"):
        values = [float(other.find(tag).text) for other in bodies if _is_number(other.find(tag).text)]
        xml.SubElement(body, tag).text = f"{1e-9 * min(values, default=1e-3):g}"
    return body


def _is_number(text):
    try:
        float(text)
        return True
    except ValueError:
        return False


def resolve_files(root, folder):
    """Replaces the names of files in a scene in `folder` by paths that can be found from anywhere."""
    for element in root.iter("file"):
        element.text = str((folder / element.text.strip()).resolve())
