// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <filesystem>
#include <string>

namespace bwfirt {

struct Conversion;

/// The files of a scene, BASE.ra2, BASE.camera and BASE.scene. They are written to a folder beside
/// them and appear together, or not at all.
class Outputs {
  public:
    /// @throws std::runtime_error where the folder cannot be made
    explicit Outputs(const std::filesystem::path& base);

    /// Removes what has not been published.
    ~Outputs();
    Outputs(const Outputs&) = delete;
    Outputs& operator=(const Outputs&) = delete;

    /// Before long work.
    /// @throws std::runtime_error where it is known already that publish() would fail, or would
    ///         overwrite the input
    void check(const std::filesystem::path& input) const;

    /// Writes all files to the folder. Sets the scene's path of its triangles.
    void write(Conversion& conversion, const std::string& comment) const;

    /// Renames the files to where they belong.
    void publish() const;

  private:
    std::filesystem::path target(const char* extension) const;
    std::string trianglesPath() const;  ///< as the scene names it
    std::filesystem::path hidden(const char* extension) const;

    std::filesystem::path base_;
    std::filesystem::path folder_;
};

}  // namespace bwfirt
