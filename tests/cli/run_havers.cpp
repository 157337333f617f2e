#include "tests/cli/run_havers.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <fstream>

namespace havers::test {

namespace fs = std::filesystem;

Answer run_havers(const fs::path& folder, const std::string& arguments) {
  const fs::path out = folder.string() + ".out", err = folder.string() + ".err";
  const std::string command = "cd '" + folder.string() + "' && '" HAVERS_PROGRAM "' " + arguments +
                              " </dev/null >'" + out.string() + "' 2>'" + err.string() + "'";
  const int status = std::system(command.c_str());
  return {.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1,
          .out = contents(out),
          .err = contents(err)};
}

fs::path own_folder() {
  static const ScratchFolder of_this_run;  // as the tests of another may run at the same time
  const auto* test = testing::UnitTest::GetInstance()->current_test_info();
  fs::path folder =
      of_this_run.path() / (std::string(test->test_suite_name()) + "." + test->name());
  fs::remove_all(folder);
  fs::create_directories(folder);
  return folder;
}

bool reads_images() {
  return run_havers(own_folder(), "--version").out.find("images OFF") == std::string::npos;
}

void write_text(const fs::path& file, const std::string& text) {
  std::ofstream(file) << text;
}

std::string replaced_once(std::string text, const std::string& what, const std::string& by) {
  return text.replace(text.find(what), what.size(), by);
}

std::string small_scene() {
  return R"([assembly]
layers = 8
fibres = 5
[joints]
resultant_MPa = 100.0
ratio = 1.0
scatter = 0.4
[loading]
strain_rate_per_s = 1e-3
)";
}

std::string small_study() {
  std::string text = R"([study]
name = "two bars"
[model.assembly]
layers = 8
fibres = 5
[model.joints]
head_tail_MPa = 80.0
ratio = 1.0
scatter = 0.4
[synthesize]
force_noise_N = 0.2
sampling_s = 0.02
toe_strain = 2e-5
[porosity]
to_scatter = "none"
[calibrate]
parameters = ["young_GPa", "head_tail_MPa"]
[calibrate.options]
replicates = 2
budget = 60
)";
  for (const char* angle : {"0", "90"})
    text +=
        std::string("[[specimen]]\nid = \"B") + angle + "\"\ntest = \"B" + angle +
        ".csv\"\nwidth_mm = 4.0\nthickness_mm = 2.0\ngauge_length_mm = 25.0\norientation_deg = " +
        angle + "\n";
  return text;
}

fs::path folder_with_scene() {
  const fs::path folder = own_folder();
  write_text(folder / "scene.toml", small_scene());
  return folder;
}

fs::path folder_with_study() {
  const fs::path folder = own_folder();
  write_text(folder / "study.toml", small_study());
  return folder;
}

fs::path folder_with_tests() {
  static const ScratchFolder of_this_run;
  static const fs::path made = [] {
    const fs::path source = of_this_run.path() / "source";
    fs::create_directory(source);
    write_text(source / "study.toml", small_study());
    EXPECT_EQ(run_havers(source, "synthesize study.toml -o made").exit_code, 0);
    return source / "made";
  }();
  fs::path folder = folder_with_study();
  fs::copy(made, folder / "made");
  return folder;
}

}  // namespace havers::test
