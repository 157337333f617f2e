// Where the pages of a TIFF are described. Private to io/images.
#pragma once

#include <vector>

#include "io/images/file_bytes.hpp"

namespace havers::images {

/// A page's directory.
struct TiffPage {
  Offset directory = 0;  ///< Its place.
  bool reduced = false;  ///< A smaller copy of another page, by its own words.
};

/// The pages of a file in its own order.
struct TiffPages {
  bool large = false;  ///< BigTIFF: places of 8 bytes.
  std::vector<TiffPage> pages;
  bool cut_off = false;  ///< The file ends where it would say whether a further page follows.
};

/// The pages of a TIFF, none of any other file. Sets the order of bytes.
TiffPages tiff_pages(FileBytes& bytes);

/// The numbers, from 0, of the pages that are no reduced copies; of all where no other is there.
std::vector<std::size_t> full_pages(const TiffPages& tiff);

}  // namespace havers::images
