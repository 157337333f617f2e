#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <cassert>

#include "io/results/result_files.hpp"
#include "io/snapshots/snapshots.hpp"

namespace havers::io {
namespace {

void add_points(vtkUnstructuredGrid& grid, const sim::Assembly& assembly,
                const Eigen::VectorXd& displacements) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkDoubleArray> shift;
  shift->SetName("displacement");
  shift->SetNumberOfComponents(3);
  for (std::size_t i = 0; i < assembly.nodes.size(); ++i) {
    // VTK has three coordinates; the model is plane.
    const auto at = 2 * static_cast<Eigen::Index>(i);
    points->InsertNextPoint(assembly.nodes[i].x(), assembly.nodes[i].y(), 0.0);
    shift->InsertNextTuple3(displacements(at), displacements(at + 1), 0.0);
  }
  grid.SetPoints(points);
  grid.GetPointData()->SetVectors(shift);
}

// A fibre's triangles carry kind 0; a joint is the line of its edge on side a.
void add_cells(vtkUnstructuredGrid& grid, const sim::Assembly& assembly,
               const std::vector<sim::JointOutcome>& joints) {
  vtkNew<vtkIntArray> kind, broken;
  vtkNew<vtkDoubleArray> gap;
  kind->SetName("kind");
  broken->SetName("broken");
  gap->SetName("gap_m");
  const auto add_cell = [&](VTKCellType type, const auto& nodes, int of_kind,
                            const sim::JointOutcome& state) {
    const std::vector<vtkIdType> ids(nodes.begin(), nodes.end());
    grid.InsertNextCell(type, static_cast<vtkIdType>(ids.size()), ids.data());
    kind->InsertNextValue(of_kind);
    broken->InsertNextValue(state.broken ? 1 : 0);
    gap->InsertNextValue(state.gap);
  };
  for (const auto& triangle : assembly.triangles) add_cell(VTK_TRIANGLE, triangle, 0, {});
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const sim::Joint& joint = assembly.joints[i];
    add_cell(VTK_POLY_LINE, joint.edge_a, joint.kind == sim::JointKind::head_tail ? 1 : 2,
             joints[i]);
  }
  for (vtkDataArray* data : {static_cast<vtkDataArray*>(kind), static_cast<vtkDataArray*>(broken),
                             static_cast<vtkDataArray*>(gap)})
    grid.GetCellData()->AddArray(data);
}

}  // namespace

bool snapshots_available() {
  return true;
}

void write_vtu(const std::filesystem::path& file, const sim::Assembly& assembly,
               const Eigen::VectorXd& displacements, const std::vector<sim::JointOutcome>& joints) {
  assert(displacements.size() == 2 * static_cast<Eigen::Index>(assembly.nodes.size()));
  assert(joints.size() == assembly.joints.size());
  vtkNew<vtkUnstructuredGrid> grid;
  add_points(*grid, assembly, displacements);
  add_cells(*grid, assembly, joints);
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  // To a text first, so that the file is written whole or not at all.
  writer->WriteToOutputStringOn();
  writer->SetInputData(grid);
  writer->Write();
  write_file(file, writer->GetOutputString());
}

}  // namespace havers::io
