"""What is known of one graph, and needs nothing of this machine: pages in the browser are made of it as well."""

from dataclasses import dataclass, field

from .graphs import of_graph6


@dataclass
class Record:
    """A graph with a page. What `verify` said stands as it was said: `report`, `models`, `name` are lines of --json."""

    graph6: str
    report: dict
    models: dict
    name: dict | None = None
    certificate: str = ""
    proof: str = ""
    picture: str = ""
    witness: str = ""
    # Of how many real solutions how many are oriented, near cameras that were found; and a picture of two scenes.
    oriented: list = field(default_factory=list)
    second_scene: str = ""
    title: str = ""
    about: str = ""
    slug: str = ""
    # Whether the atlas has a row for it.
    listed: bool = True

    @property
    def label(self):
        return self.name["label"] if self.name else None

    @property
    def size(self):
        return self.report["graph"]["nodes"], self.report["graph"]["edges"]

    @property
    def pairs(self):
        return of_graph6(self.graph6)[1]


def solutions_word(solutions):
    """A number or bounds, as in the published lists: 2, 1-3, 1-."""
    if solutions.get("exactly"):
        return str(solutions["exactly"])
    return f"{solutions['at_least']}-{solutions['at_most'] or ''}"
