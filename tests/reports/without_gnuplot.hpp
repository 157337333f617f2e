// A page's text alone: where no gnuplot is found, sentences stand in place of its figures.
#pragma once

#include <cstdlib>
#include <string>

namespace havers::test {

/// Hides gnuplot, whose start is what takes the time of a page, for as long as it lives.
class WithoutGnuplot {
 public:
  WithoutGnuplot() { setenv("PATH", "/nonexistent", 1); }
  ~WithoutGnuplot() { setenv("PATH", path_.c_str(), 1); }
  WithoutGnuplot(const WithoutGnuplot&) = delete;
  WithoutGnuplot& operator=(const WithoutGnuplot&) = delete;

 private:
  const std::string path_ = std::getenv("PATH");
};

}  // namespace havers::test
