#include "host/cli/caught_errors.h"

#include <filesystem>
#include <new>

#include "kernels/error.h"

namespace edgescout {

int with_caught_errors(const std::function<int()>& run, const Fail& fail) {
  try {
    return run();
  } catch (const InputError& error) {
    return fail(error.what(), exit_bad_request);
  } catch (const std::filesystem::filesystem_error& error) {
    return fail(error.path1().string() + ": " + error.code().message(), exit_bad_request);
  } catch (const GpuError& error) {
    return fail(error.what(), exit_device_failed);
  } catch (const std::bad_alloc&) {
    return fail("out of memory", exit_internal_error);
  } catch (const std::exception& error) {
    return fail(std::string("internal: ") + error.what(), exit_internal_error);
  }
}

}  // namespace edgescout
