#include "io/machine/text_source.hpp"

#include <fmt/format.h>
#include <iconv.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>

#include "io/input_error.hpp"
#include "io/machine/encoding.hpp"

namespace havers::io {
namespace {

constexpr std::size_t block_bytes = 1U << 18U;
constexpr std::uintmax_t largest_file = 1'000'000'000;  // [byte]

void check_openable(const std::filesystem::path& file) {
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (!std::filesystem::status_known(status))
    throw InputError(file.string(), "cannot be read: " + error.message());
  if (!std::filesystem::exists(status)) throw InputError(file.string(), "there is no such file");
  if (std::filesystem::is_directory(status))
    throw InputError(file.string(), "is a folder, not a test file", "name one of the files in it");
  if (std::filesystem::is_regular_file(status) && std::filesystem::file_size(file) > largest_file)
    throw InputError(
        file.string(),
        fmt::format("is larger than {} MB, which no tensile test is", largest_file / 1'000'000),
        "export one test alone, or fewer rows a second");
}

}  // namespace

TextSource::TextSource(const std::filesystem::path& file) : name_(file.string()) {
  check_openable(file);
  stream_.open(file, std::ios::binary);
  if (!stream_) throw InputError(name_, std::string("cannot be read: ") + std::strerror(errno));
  read_block();
  if (block_.empty()) throw InputError(name_, "the file is empty");
  std::error_code no_size;
  if (const auto bytes = std::filesystem::file_size(file, no_size); !no_size)
    first_blocks_ = static_cast<double>(bytes) / static_cast<double>(block_.size());
  const Encoding encoding = find_encoding(block_);
  if (encoding.name.empty())
    throw InputError(
        name_, "is not a text file",
        block_.starts_with("PK") ? "a spreadsheet: save it as CSV" : "export the raw data as CSV");
  encoding_ = encoding.name;
  // The first block stays in `block_` for the first call of `next`.
  block_.erase(0, encoding.mark_bytes);
  if (!encoding.convert) return;
  // NOLINTNEXTLINE(performance-no-int-to-ptr): iconv_open's own sign of failure
  if (iconv_t opened = iconv_open("UTF-8", encoding_.c_str()); opened != iconv_t(-1))
    converter_ = opened;
  else
    throw InputError(name_, "is encoded in " + encoding_ + ", which cannot be converted here",
                     "save it as UTF-8");
}

TextSource::~TextSource() {
  if (converter_ != nullptr) iconv_close(converter_);
}

std::string_view TextSource::next() {
  if (!first_) read_block();
  first_ = false;
  if (converter_ == nullptr) {
    // No copy: the block itself is handed on.
    text_.swap(block_);
    block_.clear();
  } else {
    convert_block();
  }
  return text_;
}

// Appends to what the last conversion left over.
void TextSource::read_block() {
  const std::size_t kept = block_.size();
  block_.resize(kept + block_bytes);
  stream_.read(block_.data() + kept, block_bytes);
  block_.resize(kept + static_cast<std::size_t>(stream_.gcount()));
}

// What iconv cannot read becomes '?'; a character cut off by the block's end waits for the next
// block.
void TextSource::convert_block() {
  text_.clear();
  char* in = block_.data();
  std::size_t in_left = block_.size();
  // A buffer that is full (E2BIG) is no fault: the loop goes on with it emptied.
  std::array<char, 1U << 14U> buffer{};
  while (in_left > 0) {
    char* out = buffer.data();
    std::size_t out_left = buffer.size();
    const std::size_t outcome = iconv(converter_, &in, &in_left, &out, &out_left);
    const int fault = outcome == static_cast<std::size_t>(-1) ? errno : 0;
    text_.append(buffer.data(), out);
    if (fault == EINVAL && !stream_.eof()) break;
    if (fault == EILSEQ || fault == EINVAL) {
      text_ += '?';
      const std::size_t unit = encoding_.starts_with("UTF-16") ? 2 : 1;  // a lone surrogate
      const std::size_t skipped = std::min(unit, in_left);
      in += skipped;
      in_left -= skipped;
    }
  }
  block_.erase(0, block_.size() - in_left);
}

}  // namespace havers::io
