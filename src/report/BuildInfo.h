// SPDX-License-Identifier: GPL-3.0-only
#pragma once

namespace bwfirt {

/// How this program was built. SConstruct writes the definitions.
struct BuildInfo {
    static const char* const VERSION;
    static const char* const COMMIT;    ///< of git, with "-dirty" where files differed from it
    static const char* const COMPILER;  ///< name and version
    static const char* const FLAGS;     ///< that everything but the kernel was compiled with
    static const bool DVORAK;           ///< the viewer's keys are those of a Dvorak keyboard
};

}  // namespace bwfirt
