#include <filesystem>

#include "apps/io/page/data.hpp"
#include "apps/io/page/page.hpp"
#include "apps/io/printable.hpp"
#include "apps/io/write/formats.hpp"

namespace powercell::io {

void write_html(const std::string& path, const DiagramOutput& output) {
  const std::string stem = is_standard_output(path) ? "" : std::filesystem::path(path).stem().string() + ": ";
  const std::size_t n = output.seeds.size();
  const std::string title =
      printable(stem + "power diagram of " + with_commas(n) + (n == 1 ? " seed" : " seeds"));
  AtomicFile file(path);
  for (const PagePart& part : page_parts()) {
    file.write(part.text);
    if (part.after == "TITLE") file.write(xml_text(title));
    if (part.after == "STYLE") file.write(view_file("style.css"));
    if (part.after == "DATA") write_view_data(file, output, title, path);
    if (part.after == "SCRIPT") file.write(view_script());
  }
  file.commit();
}

}  // namespace powercell::io
