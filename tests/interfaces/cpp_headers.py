"""The public names of the C++ headers: functions, types, their members, enumerations and constants."""
import pathlib
import re


def without_comments(text):
    text = re.sub(r"/\*.*?\*/", " ", text, flags=re.S)
    return re.sub(r"//.*", " ", text)


def statements(text):
    """Splits the inside of a scope into (head, body): body is the text in braces, or None for a declaration."""
    start, at = 0, 0
    while at < len(text):
        if text[at] == ";":
            yield text[start:at].strip(), None
            start = at + 1
        elif text[at] == "{":
            depth, end = 1, at + 1
            while depth:
                depth += {"{": 1, "}": -1}.get(text[end], 0)
                end += 1
            head, rest = text[start:at].strip(), text[end:].lstrip()
            is_scope = re.match(r"(enum|struct|class|namespace|extern)\b", head)
            is_function = not is_scope and re.search(r"\)\s*(const|noexcept|override|\s|:.*)*$", head, flags=re.S)
            if is_scope or is_function:
                yield head, text[at + 1 : end - 1]
                start = end
                if rest.startswith(";") or (is_scope and re.match(r"\w*;", rest)):
                    start = text.index(";", end) + 1
                at = start - 1
            else:  # an initializer
                at = end - 1
        at += 1


def declared(head):
    """The names that a declaration makes: of a function, or of variables."""
    head = re.sub(r"\s+", " ", head)
    if re.search(r"\boperator\b|^(using namespace|friend|static_assert)\b|= delete|= default", head):
        return []
    alias = re.match(r"using (\w+) =", head)
    if alias:
        return [alias[1]]
    plain = head
    while re.search(r"<[^<>]*>", plain):
        plain = re.sub(r"<[^<>]*>", "", plain)
    function = re.match(r"[^=({]*?(~?\w+)\s*\(", plain)
    if function:
        return [function[1]]
    plain = re.sub(r"\{[^{}]*\}", "", plain)
    parts = [re.sub(r"=.*", "", part).strip() for part in re.split(r",(?![^(]*\))", plain)]
    return [re.search(r"(\w+)(\[\w*\])*$", part)[1] for part in parts if re.search(r"\w$|\]$", part)]


def scope(text, prefix, is_class):
    """The names of a namespace (prefix "") or a type (prefix "Type::")."""
    public = is_class != "class"
    for head, body in statements(text):
        for label in re.findall(r"\b(public|private|protected)\s*:(?!:)", head):
            public = label == "public"
        head = re.sub(r"\b(public|private|protected)\s*:(?!:)", "", head).strip()
        if not head or not public:
            continue
        kind = re.match(r"(enum class|enum|struct|class)\s+(?:POWERCELL_API\s+)?(\w+)", head)
        if kind and body is None:
            continue  # a forward declaration
        if kind:
            yield prefix + kind[2]
            if not kind[1].startswith("enum"):
                yield from scope(body, prefix + kind[2] + "::", kind[1])
            continue
        if head.startswith("namespace"):
            continue  # cl
        for name in declared(head):
            if name.startswith("~"):
                continue
            if prefix and name == prefix.split("::")[-2] and re.search(rf"\(\s*(const )?{name}\s*&", head):
                continue  # copies and moves
            yield prefix + name


def names(header):
    text = header.read_text()
    macros = [name for name in re.findall(r"^#define (POWERCELL_VERSION\w*)", text, flags=re.M)]
    text = re.sub(r"^#.*$", "", without_comments(text), flags=re.M)
    found = list(macros)
    for head, body in statements(text):
        if re.fullmatch(r"namespace powercell", head):
            found += scope(body, "", "namespace")
    return list(dict.fromkeys(found))


def public_names(root):
    """{header: names} of include/powercell."""
    return {path.name: names(path) for path in sorted(pathlib.Path(root, "include/powercell").glob("*.hpp"))}
