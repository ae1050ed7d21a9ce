// SPDX-License-Identifier: GPL-3.0-only
#include "app/viewer/ReferenceKernel.h"

#include <dlfcn.h>

#include <filesystem>
#include <stdexcept>

namespace bwfirt {

std::unique_ptr<RTKernel> createReferenceKernel() {
    const std::filesystem::path library =
        std::filesystem::read_symlink("/proc/self/exe").parent_path() / "libbwfirt-reference.so";
    // Never closed: the kernel's code has to stay as long as the kernel.
    void* handle = dlopen(library.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (handle == nullptr)
        throw std::runtime_error(dlerror());
    void* create = dlsym(handle, "newReferenceKernel");
    if (create == nullptr)
        throw std::runtime_error(dlerror());
    return std::unique_ptr<RTKernel>(reinterpret_cast<RTKernel* (*)()>(create)());
}

}  // namespace bwfirt
