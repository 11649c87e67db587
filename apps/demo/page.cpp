#include "apps/demo/page.hpp"

#include <fmt/format.h>

#include "apps/io/printable.hpp"

namespace powercell::app {
namespace {

constexpr const char* page_start = R"(<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>powercell demo</title>
<style>
:root { color-scheme: light; --ink: #1d2b3a; --soft: #5b6b7b; --line: #dde3e9; --paper: #f6f8fa; --link: #0b5cad; }
* { box-sizing: border-box; }
body { margin: 0; background: var(--paper); color: var(--ink); font: 1rem/1.55 system-ui, sans-serif; }
header, main, footer { max-width: 76rem; margin: 0 auto; padding: 1.5rem 1rem; }
h1 { margin: 0 0 .25rem; font-size: 1.9rem; line-height: 1.2; }
h2 { margin: 0 0 .5rem; font-size: 1.25rem; }
p { margin: 0 0 .75rem; }
a { color: var(--link); }
header p { max-width: 48rem; }
.run { color: var(--soft); }
main { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(100%, 30rem), 1fr)); gap: 1.5rem; padding-top: 0; }
article { display: flex; flex-direction: column; min-width: 0; overflow: hidden; background: #fff;
  border: 1px solid var(--line); border-radius: .6rem; }
.picture { display: block; background: #fff; border-bottom: 1px solid var(--line); }
.picture img { display: block; width: 100%; height: auto; max-height: 32rem; object-fit: contain; }
.text { padding: 1rem 1.1rem 1.1rem; }
dl { display: flex; flex-wrap: wrap; gap: .25rem 1.4rem; margin: 0 0 .75rem; }
dt { color: var(--soft); font-size: .85rem; }
dd { margin: 0; font-weight: 600; font-variant-numeric: tabular-nums; }
pre { margin: 0 0 .75rem; padding: .6rem .75rem; white-space: pre-wrap; background: var(--paper); border: 1px solid var(--line);
  border-radius: .4rem; font: .85rem/1.5 ui-monospace, monospace; }
.more { margin: 0; font-size: .92rem; color: var(--soft); }
code { font-family: ui-monospace, monospace; font-size: .92em; overflow-wrap: anywhere; }
pre code { font-size: 1em; }
</style>
</head>
<body>
)";

std::string html(const std::string& text) {
  return io::xml_text(io::printable(text));
}

std::string link(const std::string& target, const std::string& text) {
  return fmt::format("<a href=\"{}\">{}</a>", html(target), html(text));
}

std::string figures_of(const DemoPart& part) {
  std::string text = "<dl>\n";
  const auto add = [&](const std::string& what, const std::string& much) {
    text += fmt::format("<div><dt>{}</dt><dd>{}</dd></div>\n", html(what), html(much));
  };
  for (const auto& [what, much] : part.figures) add(what, much);
  add("took", fmt::format("{:.1f} s", part.seconds));
  return text + "</dl>\n";
}

std::string more_of(const DemoPart& part, const DemoRun& run) {
  std::string text = "<p class=\"more\">Files: ";
  for (std::size_t k = 0; k < part.files.size(); ++k) {
    const std::string name = std::filesystem::path(part.files[k]).filename().string();
    text += (k > 0 ? ", " : "") + link(name, name);
  }
  text += fmt::format("<br>More: <code>powercell help {}</code>", part.topic);
  if (run.has_documents) text += ", " + link(run.repository + part.document, part.document_title);
  return text + "</p>\n";
}

std::string article(const DemoPart& part, const DemoRun& run) {
  return fmt::format(
      "<article id=\"{0}\">\n<a class=\"picture\" href=\"{1}\"><img src=\"{1}\" width=\"{2}\" height=\"{3}\" "
      "alt=\"{4}\"></a>\n<div "
      "class=\"text\">\n<h2>{5}</h2>\n<p>{6}</p>\n{7}<pre><code>{8}</code></pre>\n{9}</div>\n"
      "</article>\n",
      part.name, part.picture(), part.width, part.height, html(part.shown), html(part.title),
      html(part.caption), figures_of(part), html(part.command), more_of(part, run));
}

std::string header_of(const DemoRun& run) {
  std::string text =
      "<header>\n<h1>powercell demo</h1>\n<p>A power diagram divides a domain among weighted seeds: a point "
      "x belongs to "
      "the seed p of least |x − p|² − w. A weight w is a squared length, the square of a disc’s radius. "
      "These "
      "six pictures are what the tool does. The commands make the same pictures, in the folder of this "
      "page.</p>\n";
  text += fmt::format("<p class=\"run\">Computed by powercell {} on {} ({}) in {:.1f} s", version(),
                      html(run.device), html(run.platform), run.seconds);
  if (run.build > noticeable_build) text += "; kernels were compiled for it meanwhile, which is done once";
  return text + ".</p>\n</header>\n";
}

std::string footer_of(const DemoRun& run) {
  std::string text =
      "<footer>\n<p>Next: <code>powercell help</code> lists the commands. Your own seeds are rows ";
  text +=
      "<code>x y [z] weight</code> in a text or CSV file: <code>powercell diagram --domain square --seeds "
      "seeds.csv "
      "-o cells.svg</code>.</p>\n";
  if (run.has_documents) {
    text += "<p>" + link(run.repository + "README.md", "Read me");
    constexpr std::pair<const char*, const char*> documents[] = {
        {"guide", "Guide"},
        {"applications", "Applications"},
        {"gallery", "Gallery"},
        {"coming_from", "Coming from other programs"},
        {"performance", "Performance"}};
    for (const auto& [name, title] : documents)
      text += " · " + link(run.repository + "docs/" + name + ".md", title);
    text += "</p>\n";
  }
  return text + "</footer>\n";
}

}  // namespace

std::string demo_page(std::span<const DemoPart> parts, const DemoRun& run) {
  std::string page = page_start + header_of(run) + "<main>\n";
  for (const DemoPart& part : parts) page += article(part, run);
  return page + "</main>\n" + footer_of(run) + "</body>\n</html>\n";
}

}  // namespace powercell::app
