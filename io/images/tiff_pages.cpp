// Each page has a directory: how many tags, the tags, and the place of the next one.
#include "io/images/tiff_pages.hpp"

#include <algorithm>
#include <set>
#include <string>

namespace havers::images {

TiffPages tiff_pages(FileBytes& bytes) {
  const std::string order = bytes.text(0, 2);
  bytes.set_big_endian(order == "MM");
  const Offset version = bytes.number(2, 2);
  if ((order != "MM" && order != "II") || (version != 42 && version != 43)) return {};
  TiffPages found{.large = version == 43};
  // Bytes of an offset, of the number of tags, and of one tag.
  const std::size_t place = found.large ? 8 : 4, count = found.large ? 8 : 2,
                    tag = found.large ? 20 : 12;
  // Offset 0 ends the list. So does a directory met before: in a damaged file they may form a loop.
  std::set<Offset> passed{0};
  for (Offset at = bytes.number(place, place); passed.insert(at).second;) {
    // NewSubfileType has the lowest number of all tags, by which they are sorted.
    const Offset first = at + count;
    const bool reduced =
        bytes.number(first, 2) == 254 && (bytes.number(first + tag - place, 4) & 1U) != 0;
    found.pages.push_back({at, reduced});
    const Offset next = first + tag * bytes.number(at, count);
    // Of a directory that is not whole, or lies behind the file's end, the page itself is missing.
    found.cut_off = !bytes.text(next - 1, 1).empty() && bytes.text(next, place).size() < place;
    if (found.cut_off) break;
    at = bytes.number(next, place);
  }
  return found;
}

std::vector<std::size_t> full_pages(const TiffPages& tiff) {
  const bool none = std::ranges::all_of(tiff.pages, &TiffPage::reduced);
  std::vector<std::size_t> full;
  for (std::size_t i = 0; i < tiff.pages.size(); ++i)
    if (none || !tiff.pages[i].reduced) full.push_back(i);
  return full;
}

}  // namespace havers::images
