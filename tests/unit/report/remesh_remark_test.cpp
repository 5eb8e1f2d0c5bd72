#include "report/remesh_remark.h"

#include <gtest/gtest.h>

namespace zerotree::report {
namespace {

ConvertReport scan() {
  ConvertReport report;
  report.clean_faces = 100'000;
  report.components = 1;
  report.base_vertices = 180;
  report.base_faces = 356;
  report.levels = 5;
  report.discretisation_error = 6e-5;
  report.remeshing_error = 2e-4;
  return report;
}

bool names(const ConvertReport& report, const char* cause) {
  return explain_remeshing_error(report).find(cause) != std::string::npos;
}

TEST(RemeshRemark, IsSilentWhereAllIsWell) {
  ConvertReport report = scan();
  report.remeshing_error = 3 * report.discretisation_error;
  EXPECT_EQ(explain_remeshing_error(report), "");
}

TEST(RemeshRemark, NamesTheLikelyCause) {
  EXPECT_TRUE(names(scan(), "too coarse"));
  ConvertReport report = scan();
  report.levels = 3;
  EXPECT_TRUE(names(report, "--levels"));
  report = scan();
  report.genus = 40;
  EXPECT_TRUE(names(report, "40 handles"));
  report = scan();
  report.discretisation_error = 0;
  EXPECT_TRUE(names(report, "flat faces without creases"));
  report.crease_edges = 12;
  EXPECT_TRUE(names(report, "no creases are rounded"));
}

}  // namespace
}  // namespace zerotree::report
