// Bytes per second of a Bluehill file of 100 MB, and of what `havers import` does with it.
#include <benchmark/benchmark.h>

#include <filesystem>
#include <random>

#include "calib/experiment/measured_test.hpp"
#include "io/machine/read_test.hpp"

namespace havers {
namespace {

// A linear specimen to its break: time, extension, force, strain and stress.
calib::RawTest long_test(int rows) {
  std::mt19937 random(1);
  std::normal_distribution<double> noise;
  calib::RawTest test{.width = 4e-3, .thickness = 2e-3, .gauge_length = 25e-3};
  for (int i = 0; i < rows; ++i) {
    const double part = static_cast<double>(i) / rows, strain = 5e-3 * part;
    test.time.push_back(600.0 * part);
    test.extension.push_back(25e-3 * strain);
    test.force.push_back((part < 0.95 ? 104e3 * strain : 0.0) + 0.3 * noise(random));
    test.strain.push_back(strain + 1e-6 * noise(random));
    test.stress.push_back(test.force.back() / 8e-6);
  }
  return test;
}

// Written once, in the folder for temporary files, and gone with the program.
const std::filesystem::path& hundred_megabytes() {
  struct File {
    std::filesystem::path path =
        std::filesystem::temp_directory_path() / "havers_import_benchmark.csv";
    File() { io::write_bluehill(path, long_test(2'170'000)); }
    ~File() { std::filesystem::remove(path); }
    File(const File&) = delete;
    File& operator=(const File&) = delete;
    File(File&&) = delete;
    File& operator=(File&&) = delete;
  };
  static const File file;
  return file.path;
}

void count_bytes(benchmark::State& state) {
  const auto bytes = static_cast<std::int64_t>(std::filesystem::file_size(hundred_megabytes()));
  state.SetBytesProcessed(bytes * static_cast<std::int64_t>(state.iterations()));
  state.counters["MB"] = 1e-6 * static_cast<double>(bytes);
}

void ReadATest(benchmark::State& state) {
  const auto& file = hundred_megabytes();
  for (auto _ : state) benchmark::DoNotOptimize(io::read_test(file));
  count_bytes(state);
}
BENCHMARK(ReadATest)->Unit(benchmark::kMillisecond);

void ReadAndReduceATest(benchmark::State& state) {
  const auto& file = hundred_megabytes();
  for (auto _ : state) {
    io::TestFile read = io::read_test(file);
    benchmark::DoNotOptimize(calib::reduce_test(read.test));
  }
  count_bytes(state);
}
BENCHMARK(ReadAndReduceATest)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace havers
