"""Formulas in plain text, as docs/mathematics.md has them, to HTML: italic letters, subscripts and superscripts."""

import re

NUMBER = re.compile(r"\((\d+[a-h]?)\)(\*?)")
TOKEN = re.compile(
    r"""(?P<gap>\ {2,})
    | [_^]\{(?P<braces>[^{}]*)\}
    | (?P<script>[_^])(?:\((?P<group>(?:[^()]|\([^()]*\))*)\)|(?P<plain>-?[A-Za-z0-9αβγλρτ]+(?:[+-]\d)?'?))
    | (?P<word>[A-Za-zα-ω]+(?:'s\b)?)
    | (?P<other>.)""",
    re.X,
)
WORDS = {"min", "max", "pow", "dist", "det", "sqrt", "log", "exp", "sin", "over", "region"}
ENTITIES = {character: f"&#{ord(character)};" for character in "&<>|*_[]`\\~\"$"}


def escaped(text):
    """Characters that neither HTML nor Markdown takes for its own."""
    return "".join(ENTITIES.get(character, character) for character in text)


def html(text):
    """The formula as HTML inline elements."""
    text = text.replace("sqrt(", "√(")
    result = []
    for token in TOKEN.finditer(text):
        kind = token.lastgroup
        if kind == "gap":
            result.append('<span class="gap"></span>')
        elif kind == "braces":
            tag = "sub" if token[0][0] == "_" else "sup"
            result.append(f"<{tag}>{html(token['braces'])}</{tag}>")
        elif kind in ("group", "plain"):
            tag = "sub" if token["script"] == "_" else "sup"
            result.append(f"<{tag}>{html(token[kind])}</{tag}>")
        elif kind == "word" and is_letter(token, bool(result)):
            result.append(f"<i>{token[0]}</i>")
        else:
            result.append(escaped(token[0].replace("'", "′").replace("-", "−")))
    return "".join(result)


def is_letter(token, first_found):
    """Whether a word is a letter of the formula, or several of a subscript such as ij, and no article."""
    after = token.string[token.end() :]
    if token[0] == "a":
        return not re.match(r" [a-z]{3,}", after)
    return len(token[0]) == 1 or (len(token[0]) == 2 and not first_found and not after)


def is_formula(code):
    """Whether a code span in a text is a formula, and no name of the library: its words are letters, or known."""
    if re.search(r"::|\.[a-z]|--", code):
        return False
    words = re.findall(r"[A-Za-z]+", re.sub(r"_([a-z0-9]{1,3}|max)\b", "", code))
    return bool(re.search(r"[²∂∫Σ≤≥⁻¹]| = ", code)) or all(len(word) <= 2 or word in WORDS for word in words)


def block(lines):
    """A block of formulas, each with its number."""
    rows = []
    for line in lines:
        line = line.strip()
        number = NUMBER.match(line)
        if number:
            label = f'<span class="number" id="formula-{number[1]}">({number[1]}){escaped(number[2])}</span>'
            rest = line[number.end() :]
        else:
            label, rest = "<span></span>", line
        rows.append(f'{label}<span class="formula">{html(rest.strip())}</span>')
    return '<div class="formulas">' + "\n".join(rows) + "</div>"


def in_spans(text):
    """Code spans of a line that are formulas, set as such."""

    def span(match):
        return f'<span class="formula">{html(match[1])}</span>' if is_formula(match[1]) else match[0]

    return re.sub(r"(?<!`)`([^`\n]+)`(?!`)", span, text)
