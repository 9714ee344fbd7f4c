"""The contraction of a graph, told from the bodies of its certificate (docs/certificate.md, section 5)."""

from html import escape

from .pictures import COLOURS, step


def named(nodes):
    """1, 2 and 3."""
    words = [str(v) for v in nodes]
    return words[0] if len(words) == 1 else ", ".join(words[:-1]) + " and " + words[-1]


class Story:
    """Steps of words and pictures."""

    def __init__(self, certificate, pairs, where):
        self.certificate, self.pairs, self.where = certificate, [tuple(p) for p in pairs], where
        self.bodies = []  # sets of pairs
        self.used = set()
        self.steps = []

    def show(self, words, ring=()):
        colour_of = {}
        for k, body in enumerate(self.bodies):
            if k not in self.used:
                colour_of.update(dict.fromkeys(body, COLOURS[k % len(COLOURS)]))
        self.steps.append((words, step(self.where, self.pairs, colour_of, ring, words)))

    def take(self, group):
        """The pairs of a pair, or of an earlier body, which is used up."""
        if isinstance(group, int):
            self.used.add(group)
            return self.bodies[group], f"body {group + 1}"
        pair = tuple(sorted(group))
        return {pair}, f"the pair {pair[0]}-{pair[1]}"

    def tell(self):
        """The steps, as pairs of words and pictures."""
        for number, body in enumerate(self.certificate["bodies"], 1):
            pairs, what = self.take(body["seed"])
            mine = set(pairs)
            self.bodies.append(mine)
            start = f"Body {number} starts from {what}."
            for v, a, b in body["add"]:
                mine |= {tuple(sorted((v, a))), tuple(sorted((v, b)))}
                self.show(f"{start} Camera {v} is matched to {a} and {b}, which are in it: it joins.".strip(), {v})
                start = ""
            for merge in body["merge"]:
                names = []
                for group in merge["with"]:
                    pairs, what = self.take(group)
                    mine |= pairs
                    names.append(what)
                rule = {1: "shares two cameras with it", 2: "hang together with it in a triangle", 5: "are a K2,3 with it"}
                why = rule.get(len(names), "merge with it")
                what = named(names)
                self.show(f"{start} {what[0].upper()}{what[1:]} {why}, at the cameras {named(merge['at'])}: one body.".strip(), set(merge["at"]))
                start = ""
            if not body["add"] and not body["merge"]:
                self.show(start)
        left = [k for k in range(len(self.bodies)) if k not in self.used]
        loose = len(self.pairs) - sum(len(self.bodies[k]) for k in left)
        if len(left) == 1 and not loose and len(set().union(*self.bodies[left[0]])) == len(self.where):
            end = "One body holds all cameras: they are determined uniquely."
        elif left:
            end = f"No rule goes on: {len(left)} {'body' if len(left) == 1 else 'bodies'} and {loose} loose pairs are left, for the algebra."
        else:
            end = "No rule of contraction begins: all of it is left for the algebra."
        # The last picture is that of the end.
        words, picture = self.steps.pop() if self.steps else ("", "")
        return [*self.steps, (f"{words} {end}".strip(), picture)]


def listed(steps):
    """Steps as HTML; one without a picture is a sentence."""
    if not steps[0][1]:
        return f"<p>{escape(steps[0][0])}</p>"
    items = "".join(f"<li><figure>{picture}<figcaption>{escape(words)}</figcaption></figure></li>" for words, picture in steps)
    return f'<ol class="story">{items}</ol>'
