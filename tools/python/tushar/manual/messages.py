"""The catalogue of messages: families with a number, a cause and a remedy (tools/manual_pages/messages)."""
import dataclasses
import functools
import re
import tomllib

from tushar.program import ROOT

CATALOGUE = ROOT / "tools/manual_pages/messages"


@dataclasses.dataclass(frozen=True)
class Family:
    """Messages with the same cause; `words` are their fixed words, with … for inserted values."""
    id: str
    title: str
    words: tuple
    cause: str
    remedy: str

    def fits(self, text):
        """Number of letters of the family's words if they occur in a message in this order, otherwise 0."""
        return max((len(words.replace("…", "")) for words in self.words if pattern(words).search(text)), default=0)


@functools.cache
def pattern(words):
    """A regular expression that finds the fixed words in a message, or in the template that forms it."""
    return re.compile(".*?".join(re.escape(part) for part in words.split("…")), re.DOTALL)


@functools.cache
def catalogue():
    """Returns (families in the order of their codes, texts that are only parts of messages)."""
    files = [tomllib.loads(file.read_text()) for file in sorted(CATALOGUE.glob("*.toml"))]
    entries = [entry for file in files for entry in file.get("family", ())]
    families = [Family(**{**entry, "words": tuple(entry["words"])}) for entry in entries]
    return families, tuple(part for file in files for part in file.get("fragments", ()))


def family_of(text):
    """The family with this code, or the one whose matching words in a message of sus are the longest; or None."""
    numbered = [family for family in catalogue()[0] if family.id == text.strip()]
    if numbered:
        return numbered[0]
    best = max(catalogue()[0], key=lambda family: family.fits(text))
    return best if best.fits(text) else None


def is_fragment(text):
    """Whether a text of the sources is only a part of a message, or not a message at all."""
    return any(pattern(words).fullmatch(text.strip()) for words in (part.strip() for part in catalogue()[1]))
