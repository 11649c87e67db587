#!/bin/sh
# Runs the code in the documents and builds the documentation site (docs/site/build.sh). Then checks what Sphinx does not: that
# each link and picture of the pages exists, and that the site's search knows each of the questions.
# Needs ./setup.sh gates, a build in build/release, and python/tests/run.sh for a Python environment with the package.
set -eu
cd "$(dirname "$0")/.."
docs/site/build.sh "$@"
python3 - build/site <<'END'
import html.parser, json, pathlib, re, sys, urllib.parse

site = pathlib.Path(sys.argv[1]).resolve()


class Page(html.parser.HTMLParser):
    """Names and links of a page."""

    def __init__(self, path):
        super().__init__()
        self.names, self.links = set(), []
        self.feed(path.read_text())

    def handle_starttag(self, tag, attributes):
        for key, value in attributes:
            if key == "id" or (key == "name" and tag == "a"):
                self.names.add(value)
            elif key in ("href", "src") and value:
                self.links.append(value)


pages = {path: Page(path) for path in sorted(site.rglob("*.html"))}
faults, links = [], 0
for path, page in pages.items():
    for link in page.links:
        if re.match(r"[a-z]+:|//", link):
            continue
        links += 1
        file, _, name = urllib.parse.unquote(link).partition("#")
        target = (path.parent / file.split("?")[0]).resolve() if file.split("?")[0] else path
        if not target.exists():
            faults.append(f"{path.relative_to(site)}: the link {link} leads nowhere")
        elif name and target in pages and name not in pages[target].names:
            faults.append(f"{path.relative_to(site)}: no section for the link {link}")

index = json.loads(re.search(r"Search\.setIndex\((.*)\)", (site / "searchindex.js").read_text(), re.S)[1])
asked = re.findall(r"^## (.*)", pathlib.Path("docs/questions.md").read_text(), re.M)
number = index["docnames"].index("questions")
for question in asked:
    places = index["alltitles"].get(question.replace("`", ""), [])
    if number not in [place[0] for place in places]:
        faults.append(f"the search does not find the question: {question}")
if faults:
    sys.exit("\n".join(faults))
print(f"check_site: {links} links of {len(pages)} pages lead somewhere, {len(asked)} questions are found")
END
