#include <gtest/gtest.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

#include "io/input_error.hpp"
#include "io/snapshots/snapshots.hpp"

namespace havers::io {
namespace {

// Records `rows` rows whose displacement is the row's number; answers which rows were chosen.
std::vector<int> chosen_rows(int count, int rows) {
  SnapshotRecorder recorder(count);
  const std::vector<sim::JointOutcome> joints;
  sim::Simulation end;
  for (int row = 0; row < rows; ++row) {
    end.displacements = Eigen::VectorXd::Constant(2, row);
    end.curve.emplace_back();
    recorder.record(
        {end.curve.back(), end.curve.size() - 1, joints, [&end] { return end.displacements; }});
  }
  recorder.finish(end);
  std::vector<int> chosen;
  for (const Snapshot& snapshot : recorder.chosen()) {
    EXPECT_EQ(snapshot.displacements(0), static_cast<double>(snapshot.row));
    chosen.push_back(static_cast<int>(snapshot.row));
  }
  return chosen;
}

TEST(SnapshotRecorder, SpreadsItsMomentsOverARunOfAnyLength) {
  for (const int count : {2, 3, 7, 20}) {
    for (const int rows : {20, 21, 100, 1000, 1025}) {
      SCOPED_TRACE(testing::Message() << count << " of " << rows);
      const std::vector<int> chosen = chosen_rows(count, rows);
      ASSERT_EQ(chosen.size(), static_cast<std::size_t>(count));
      EXPECT_EQ(chosen.front(), 0);
      EXPECT_EQ(chosen.back(), rows - 1);
      const double even = (rows - 1.0) / (count - 1.0);
      for (std::size_t i = 1; i < chosen.size(); ++i) {
        EXPECT_GT(chosen[i], chosen[i - 1]);
        EXPECT_LT(chosen[i] - chosen[i - 1], 2.5 * even + 1.0);
      }
    }
  }
}

TEST(SnapshotRecorder, KeepsAllRowsOfAShortRunAndTheLastWhenAskedForOne) {
  EXPECT_EQ(chosen_rows(5, 3), (std::vector{0, 1, 2}));
  EXPECT_EQ(chosen_rows(1, 50), (std::vector{49}));
  EXPECT_TRUE(chosen_rows(0, 50).empty());
  EXPECT_TRUE(chosen_rows(4, 0).empty());
}

// The quasi-static limit shows every second row, after each break.
TEST(SnapshotRecorder, NamesTheRowsOfTheCurve) {
  SnapshotRecorder recorder(4);
  sim::Simulation run;
  run.curve.resize(1);
  run.displacements = Eigen::VectorXd::Ones(2);
  for (int i = 0; i < 2; ++i) {
    run.curve.resize(run.curve.size() + 2);
    recorder.record(
        {run.curve.back(), run.curve.size() - 1, {}, [&run] { return run.displacements; }});
  }
  recorder.finish(run);
  ASSERT_EQ(recorder.chosen().size(), 2U);
  EXPECT_EQ(recorder.chosen().front().row, 2U);
  EXPECT_EQ(recorder.chosen().back().row, 4U);
}

// Two triangles and one joint between them.
sim::Assembly two_triangles() {
  sim::Assembly assembly;
  assembly.nodes = {{0, 0}, {1, 0}, {0, 1}, {1, 0}, {1, 1}, {0, 1}};
  assembly.triangles = {{0, 1, 2}, {3, 4, 5}};
  sim::Joint joint;
  joint.kind = sim::JointKind::head_tail;
  joint.edge_a = {1, 2};
  joint.edge_b = {3, 5};
  assembly.joints = {joint};
  return assembly;
}

TEST(Vtu, ReadsBackAsWritten) {
  const auto file = std::filesystem::path(testing::TempDir()) / "two_triangles.vtu";
  const Eigen::VectorXd displacements = Eigen::VectorXd::LinSpaced(12, 0.0, 11.0);
  sim::JointOutcome joint;
  joint.broken = true;
  joint.gap = 0.25;
  write_vtu(file, two_triangles(), displacements, {joint});

  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  vtkUnstructuredGrid& grid = *reader->GetOutput();
  ASSERT_EQ(grid.GetNumberOfPoints(), 6);
  ASSERT_EQ(grid.GetNumberOfCells(), 3);
  EXPECT_EQ(grid.GetPoint(4)[1], 1.0);
  EXPECT_EQ(grid.GetPointData()->GetArray("displacement")->GetComponent(5, 1), 11.0);
  EXPECT_EQ(grid.GetCellType(2), VTK_POLY_LINE);
  EXPECT_EQ(grid.GetCellData()->GetArray("kind")->GetComponent(0, 0), 0.0);
  EXPECT_EQ(grid.GetCellData()->GetArray("kind")->GetComponent(2, 0), 1.0);
  EXPECT_EQ(grid.GetCellData()->GetArray("broken")->GetComponent(2, 0), 1.0);
  EXPECT_EQ(grid.GetCellData()->GetArray("gap_m")->GetComponent(2, 0), 0.25);
}

TEST(Vtu, SaysWhereItCannotBeWritten) {
  EXPECT_THROW(write_vtu("/nowhere/at/all.vtu", two_triangles(), Eigen::VectorXd::Zero(12), {{}}),
               InputError);
}

}  // namespace
}  // namespace havers::io
