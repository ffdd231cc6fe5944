// Which exit code and which line follow from an exception.
#include "host/cli/caught_errors.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <new>

#include "kernels/error.h"

namespace edgescout::test {
namespace {

template <typename Error>
void expect_caught(const Error& error, ExitCode expected, const std::string& words) {
  int calls = 0;
  const int code = with_caught_errors([&]() -> int { throw error; },
                                      [&](const std::string& message, ExitCode found) {
                                        ++calls;
                                        EXPECT_EQ(message, words);
                                        return static_cast<int>(found);
                                      });
  EXPECT_EQ(code, expected) << words;
  EXPECT_EQ(calls, 1);
}

TEST(CaughtErrors, HaveTheCodeOfTheirKind) {
  expect_caught(InputError("a.png", "size", "1x1", "16x16"), exit_bad_request,
                "a.png: size: found 1x1, expected 16x16");
  expect_caught(std::filesystem::filesystem_error(
                    "status", "folder/x", std::make_error_code(std::errc::permission_denied)),
                exit_bad_request, "folder/x: Permission denied");
  expect_caught(GpuError("dcd_seed: VK_ERROR_DEVICE_LOST"), exit_device_failed,
                "dcd_seed: VK_ERROR_DEVICE_LOST");
  expect_caught(std::bad_alloc(), exit_internal_error, "out of memory");
  expect_caught(LogicError("grid: size"), exit_internal_error, "internal: grid: size");
}

TEST(CaughtErrors, LeaveTheCodeOfARunWithoutAny) {
  const Fail fail = [](const std::string&, ExitCode) { return -1; };
  EXPECT_EQ(with_caught_errors([] { return 1; }, fail), 1);
}

}  // namespace
}  // namespace edgescout::test
