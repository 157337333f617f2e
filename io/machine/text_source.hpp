// A text file of any encoding as a stream of UTF-8 blocks.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace havers::io {

/// Opens a text file, finds its encoding from the first block and hands the text on block by block,
/// so that memory does not grow with the file.
class TextSource {
 public:
  /// @throws InputError when the file is missing, a directory, empty or not text.
  explicit TextSource(const std::filesystem::path& file);
  ~TextSource();
  TextSource(const TextSource&) = delete;
  TextSource& operator=(const TextSource&) = delete;
  TextSource(TextSource&&) = delete;
  TextSource& operator=(TextSource&&) = delete;

  /// "ASCII", "UTF-8", "UTF-8 with BOM", "UTF-16LE", "WINDOWS-1252", ...
  [[nodiscard]] const std::string& encoding() const { return encoding_; }

  /// How many times the first block the file is; 0 where it does not tell, as a pipe.
  [[nodiscard]] double first_blocks() const { return first_blocks_; }

  /// The next block as UTF-8, without a byte order mark; empty at the end. Valid until the next
  /// call.
  std::string_view next();

 private:
  /// Appends the next bytes of the file to `block_`.
  void read_block();
  /// Fills `text_` from `block_`, in which a character cut off at its end stays.
  void convert_block();

  std::string name_;  // of the file, for messages
  std::ifstream stream_;
  std::string encoding_;
  std::string block_;          // raw bytes; begins with what the last conversion left over
  std::string text_;           // converted
  void* converter_ = nullptr;  // iconv_t; null: the bytes are UTF-8 already
  double first_blocks_ = 0.0;
  bool first_ = true;  // the constructor has read the first block, and `next` has not given it yet
};

}  // namespace havers::io
