"""Builds the site: collects the sources, renders every page, writes the search index."""
import json
import pathlib
import re
import shutil
import subprocess

from tushar.manual import (api, markdown, messages, pages_gallery, pages_other, pages_reference, reference, scenes,
                           tags, templates)
from tushar.program import ROOT

SOURCES = "tools/manual_pages"
TUTORIALS = ("first_run", "own_material", "component", "restart_and_ranks", "refined_grids", "from_uintah")
HOME_PICTURE = "ups/mpm/sod.png"


class Site:
    """The manual before it is written: {url: text}, pictures to be copied, entries for the search."""

    def __init__(self, sus, album):
        self.files, self.assets, self.entries = {}, {}, []
        self.album = album
        self.version = subprocess.run([str(sus), "-V"], capture_output=True, text=True).stdout.strip() or "sus"
        self.sections = tags.tags_of(sus)
        self.reference = reference.build(self.sections)
        reference.link_shapes(self.reference)
        self.scenes = scenes.scenes()
        self.undescribed = scenes.note_uses(self.scenes, self.reference, self.sections)
        self.headers = api.headers()
        self.urls = self._urls()
        self.renderer = markdown.Renderer(self.urls, self.assets, self._terms())
        self._add_tags()
        self._add_scenes()
        self._add_messages()
        self._add_api()
        methods, tutorials = self._add_readmes(), self._add_tutorials()
        self._add_indices(methods, tutorials)

    def _urls(self):
        """{path in the repository: page of the manual}."""
        urls = {scene.path: scene.url for scene in self.scenes}
        for path in readmes():
            urls[path] = method_url(path)
            if path.endswith("README.md") and "/" in path:
                urls[path.removesuffix("/README.md")] = method_url(path)
        urls |= {f"{SOURCES}/{name}.md": f"tutorials/{name}.html" for name in TUTORIALS}
        for folder, files in self.headers.items():
            urls |= {path: f"api/{folder}.html#{pages_other.anchor_of(path)}" for path in files}
            urls.setdefault(f"core/{folder}", f"api/{folder}.html")
        return urls

    def _terms(self):
        """{text in `code`: page} for codes of messages, and for tags whose name is unique."""
        found = {}
        for page in self.reference.pages:
            for item in page.items:
                if item.tag.kind == "tag" and item.tag.status == "used":
                    found.setdefault(item.tag.title(), set()).add(f"{page.url}#{item.anchor}")
        terms = {title: urls.pop() for title, urls in found.items() if len(urls) == 1}
        return terms | {family.id: f"messages.html#{family.id}" for family in messages.catalogue()[0]}

    def _search(self, kind, title, url, text="", where=""):
        self.entries.append([kind, title, url, re.sub(r"\s+", " ", text)[:240], where])

    def _add_tags(self):
        known = {scene.path: scene for scene in self.scenes}
        for page in self.reference.pages:
            self.files[page.url] = pages_reference.tag_page(page, self.reference, known, self.version)
            for item in page.items:
                readers = ", ".join(dict.fromkeys(section.name for section, _ in item.paths if section.kind != "scene"))
                where = item.paths[0][1] + (f" · {readers}" if readers else "")
                self._search("tag", item.tag.title(), f"{page.url}#{item.anchor}", item.tag.sentence, where)
        for section, page in self.reference.roots:
            self._search("tag", page.tag.title(), page.url, page.tag.sentence, section.name)
        self.files["reference/index.html"] = pages_reference.index_page(self.reference, self.version)
        self.files["reference/a-z.html"] = pages_reference.a_to_z_page(self.reference, self.version)
        self.files["reference/uintah.html"] = pages_reference.uintah_page(self.reference, self.version)
        self._search("page", "Uintah's tags and Tushar's", "reference/uintah.html",
                     "limited, refused, without effect, new")
        self._search("page", "All tags from A to Z", "reference/a-z.html")

    def _add_scenes(self):
        linker = pages_gallery.Linker(lambda scene: scenes.sections_of(scene, self.reference, self.sections),
                                      self.reference)
        pictures = {}
        for scene in self.scenes:
            picture = self.album.picture(scene)
            if picture:
                pictures[scene.path] = f"pictures/{scene.path.removesuffix('.ups').replace('/', '-')}.png"
                self.assets[str(picture)] = pictures[scene.path]
            self.files[scene.url] = pages_gallery.scene_page(scene, pictures.get(scene.path), self.album.report(scene),
                                                             linker, self.version)
            self._search("scene", scene.title, scene.url, scene.head.get("What", ""), scene.path)
        self.files["gallery/index.html"] = pages_gallery.gallery_page(self.scenes, pictures, self.version)

    def _add_messages(self):
        families = messages.catalogue()[0]
        found = {}
        self.unnumbered = []
        for template in templates.templates():
            family = None if messages.is_fragment(template.text) else messages.family_of(template.text)
            if family:
                found.setdefault(family.id, []).append(template)
            elif not messages.is_fragment(template.text):
                self.unnumbered.append(template)
        self.messages = sum(map(len, found.values()))
        self.files["messages.html"] = pages_other.message_page(families, found, self.version)
        for family in families:
            self._search("message", f"{family.id} {family.title}", f"messages.html#{family.id}", family.cause)

    def _add_api(self):
        for url, text in pages_other.api_pages(self.headers, self.version):
            self.files[url] = text
        for folder, files in self.headers.items():
            for path, symbols in files.items():
                for symbol, anchor in zip(symbols, pages_other.symbol_anchors(path, symbols)):
                    self._search("C++", symbol.full_name, f"api/{folder}.html#{anchor}", symbol.comment, path)

    def _add_page(self, path, url, kind, lead=""):
        """Renders a Markdown file and adds it; returns (url, title, first sentence)."""
        text = (ROOT / path).read_text()
        body, headings = self.renderer.render(text, path, url)
        title = markdown.title_of(text) or path
        self.files[url] = pages_other.page(url, title, body, self.version, lead)
        intro = re.search(r"^# .+\n\s*\n([A-Z].*(?:\n(?!\n).+)*)", text, re.MULTILINE)
        intro = re.sub(r"[`*]|\[([^\]]*)\]\([^)]*\)", r"\1", " ".join(intro[1].split())) if intro else ""
        sentence = re.split(r"(?<=[.:]) (?=[A-Z])", intro)[0].rstrip(":")
        self._search(kind, title, url, intro)
        for anchor, heading in headings:
            self._search(kind, heading, f"{url}#{anchor}", "", title)
        return url, title, sentence

    def _add_readmes(self):
        here = '<a href="index.html">Methods</a>'
        return [self._add_page(path, method_url(path), "page", here) for path in readmes()]

    def _add_tutorials(self):
        here = '<a href="index.html">Tutorials</a>'
        return [self._add_page(f"{SOURCES}/{name}.md", f"tutorials/{name}.html", "tutorial", here)
                for name in TUTORIALS]

    def _add_indices(self, methods, tutorials):
        self.files["methods/index.html"] = pages_other.list_page(
            "methods/index.html", "Methods and measurements", "The pages next to the code and the scenes.",
            methods, self.version)
        self.files["tutorials/index.html"] = pages_other.list_page(
            "tutorials/index.html", "Tutorials",
            "Each takes a few minutes. A test runs the commands, except where a note gives a reason.", tutorials,
            self.version)
        self.assets[HOME_PICTURE] = "pictures/" + HOME_PICTURE.replace("/", "-")
        counts = {"tags": sum(len(page.items) for page in self.reference.pages), "scenes": len(self.scenes),
                  "families": len(messages.catalogue()[0]), "messages": self.messages,
                  "symbols": sum(len(symbols) for files in self.headers.values() for symbols in files.values())}
        self.files["index.html"] = pages_other.home_page(tutorials, counts, self.assets[HOME_PICTURE], self.version)

    def write(self, out):
        """Writes the site into a folder, replacing an earlier one."""
        out = pathlib.Path(out)
        if out.exists() and any(out.iterdir()) and not (out / "search-index.js").exists():
            raise FileExistsError(f"{out} contains something other than a manual; choose another folder")
        shutil.rmtree(out, ignore_errors=True)
        for url, text in self.files.items():
            (out / url).parent.mkdir(parents=True, exist_ok=True)
            (out / url).write_text(text)
        for source, target in self.assets.items():
            (out / target).parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(ROOT / source, out / target)
        for name in ("style.css", "site.js"):
            shutil.copyfile(ROOT / SOURCES / name, out / name)
        families = [[family.id, family.title, [words.split("…") for words in family.words]]
                    for family in messages.catalogue()[0]]
        index = f"const ENTRIES = {_json(self.entries)};\nconst FAMILIES = {_json(families)};\n"
        (out / "search-index.js").write_text(index)


def _json(value):
    return json.dumps(value, ensure_ascii=False, separators=(",", ":")).replace("],[", "],\n[")


def readmes():
    """The Markdown pages of the repository that are not tutorials; the first page comes first."""
    found = [file.relative_to(ROOT).as_posix() for folder in ("components", "core", "ups", "tests", "tools")
             for file in sorted((ROOT / folder).rglob("README.md"))]
    extra = [path for path in (".github/CONTRIBUTING.md",) if (ROOT / path).exists()]
    return ["README.md", *found, *extra]


def method_url(path):
    """The URL of a method's page: components/heat/README.md -> methods/components-heat.html."""
    name = path.removesuffix("/README.md").removesuffix(".md").replace("/", "-").lstrip(".").lower()
    return f"methods/{name}.html"
