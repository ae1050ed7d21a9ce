// SPDX-License-Identifier: GPL-3.0-only

// What the address sanitizer has to know of libraries that are not ours. In builds with it alone.

/// Replaces the function of the C library. SDL closes libraries that hold memory till the end of
/// the program; closed, they could no longer tell of it, and it would look like a leak.
extern "C" int dlclose(void*) {
    return 0;
}

/// Asked by the sanitizer for leaks that it shall not report: clang's OpenMP keeps what it made for
/// tasks till the end of the program.
extern "C" const char* __lsan_default_suppressions() {
    return "leak:libdbus\nleak:libomp\n";
}
extern "C" const char* __lsan_default_options() {
    return "print_suppressions=0";
}
