// copy_bytes_per_s (kernels/copy_speed.h) of a Vulkan device.
#pragma once

namespace edgescout::gpu {

double copy_bytes_per_s(int device_index);

}  // namespace edgescout::gpu
