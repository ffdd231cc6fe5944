#include "bench/report.h"

#include <cctype>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace edgescout::bench {

namespace {

std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    result += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  }
  return result + "\"";
}

// "vulkan:0 llvmpipe (LLVM 15.0.6, 256 bits)" -> "vulkan-0-llvmpipe-LLVM-15.0.6-256-bits"
std::string file_name(const std::string& device) {
  std::string name;
  for (const char c : device) {
    if (std::isalnum(static_cast<unsigned char>(c)) || c == '.')
      name += c;
    else if (!name.empty() && name.back() != '-')
      name += '-';
  }
  while (!name.empty() && name.back() == '-') name.pop_back();
  return name;
}

std::string row_json(const Row& row) {
  std::ostringstream out;
  out.precision(6);
  out << "    {\"kernel\": " << quoted(row.kernel) << ", \"size\": " << quoted(row.size)
      << ", \"repetitions\": " << row.repetitions << ", \"median_ms\": " << row.median_ms
      << ", \"min_ms\": " << row.min_ms << ", \"max_ms\": " << row.max_ms
      << ", \"bytes\": " << row.bytes << ", \"gigabytes_per_s\": " << row.gigabytes_per_s()
      << ", \"stages_ms\": {";
  for (std::size_t i = 0; i < row.stages.size(); ++i)
    out << (i > 0 ? ", " : "") << quoted(row.stages[i].name) << ": "
        << 1e3 * row.stages[i].seconds / row.repetitions;
  out << "}}";
  return out.str();
}

}  // namespace

void print_table(const Report& report) {
  std::printf("\n%s (%s), %d threads, commit %s\n", report.device.c_str(), report.driver.c_str(),
              report.threads, report.commit.c_str());
  std::printf("%-22s %-46s %4s %10s %10s %10s %8s\n", "kernel", "size", "n", "median ms", "min ms",
              "max ms", "GB/s");
  for (const Row& row : report.rows) {
    std::printf("%-22s %-46s %4d %10.3f %10.3f %10.3f %8.2f\n", row.kernel.c_str(),
                row.size.c_str(), row.repetitions, row.median_ms, row.min_ms, row.max_ms,
                row.gigabytes_per_s());
    if (row.stages.size() < 2) continue;
    for (const StageTime& stage : row.stages)
      std::printf("    %-65s    %10.3f\n", stage.name.c_str(),
                  1e3 * stage.seconds / row.repetitions);
  }
}

std::string write_json(const Report& report, const std::string& folder) {
  std::filesystem::create_directories(folder);
  const std::string path = folder + "/" + file_name(report.device) + ".json";
  std::ofstream out(path);
  out << "{\n  \"device\": " << quoted(report.device)
      << ",\n  \"driver\": " << quoted(report.driver)
      << ",\n  \"commit\": " << quoted(report.commit) << ",\n  \"threads\": " << report.threads
      << ",\n  \"kernels\": [\n";
  for (std::size_t i = 0; i < report.rows.size(); ++i)
    out << row_json(report.rows[i]) << (i + 1 < report.rows.size() ? ",\n" : "\n");
  out << "  ]\n}\n";
  out.close();
  if (!out) throw std::runtime_error(path + ": cannot be written");
  return path;
}

}  // namespace edgescout::bench
