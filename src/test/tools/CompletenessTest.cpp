// SPDX-License-Identifier: GPL-3.0-only
#include "tools/import/Completeness.h"

#include "test/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace bwfirt {
namespace {

/// What is wrong with a file of this name and content, without its path; "" for nothing.
std::string complaintAbout(const std::string& name, const std::string& content) {
    const test::TemporaryFolder folder;
    const std::string path = folder.write(name, content).string();
    try {
        requireComplete(path);
    } catch (const std::runtime_error& error) {
        return std::string(error.what()).substr(path.size() + 2);
    }
    return "";
}

const std::string POINTS =
    "ply\nformat ascii 1.0\ncomment by hand\nelement vertex 2\n"
    "property float x\nproperty list uchar int friends\nend_header\n";

TEST(Completeness, AnAsciiPlyFileEndsWithItsLastValue) {
    EXPECT_EQ(complaintAbout("a.ply", POINTS + "1.5 0\n-2 3 7 8 9"), "");
    EXPECT_EQ(complaintAbout("a.ply", POINTS + "1.5 0\n-2 3 7 8"), "ends before vertex 2 of 2");
    EXPECT_EQ(complaintAbout("a.ply", POINTS + "1.5"), "ends before vertex 1 of 2");
    EXPECT_EQ(complaintAbout("a.ply", POINTS.substr(0, POINTS.size() - 5)),
              "ends within its header");
}

TEST(Completeness, ABinaryPlyFileIsWalkedInItsByteOrder) {
    for (const bool isBig : {false, true}) {
        const std::string header =
            std::string("ply\r\nformat binary_") + (isBig ? "big" : "little") +
            "_endian 1.0\r\nelement face 1\r\nproperty list ushort double d\r\nend_header\n";
        const std::string two = isBig ? std::string("\0\2", 2) : std::string("\2\0", 2);
        EXPECT_EQ(complaintAbout("a.ply", header + two + std::string(16, 'x')), "");
        EXPECT_EQ(complaintAbout("a.ply", header + two + std::string(15, 'x')),
                  "ends before face 1 of 1");
        EXPECT_EQ(complaintAbout("a.ply", header + "\2"), "ends before face 1 of 1");
    }
}

TEST(Completeness, AnAsciiStlFileEndsWithEndsolid) {
    EXPECT_EQ(complaintAbout("a.STL", "solid a\nendsolid a\n"), "");
    EXPECT_EQ(complaintAbout("a.stl", "solid a\nfacet"), "ends without the line 'endsolid'");
}

TEST(Completeness, ABinaryStlFileMayBeginWithSolid) {
    const std::string header = "solid" + std::string(75, ' ') + std::string("\1\0\0\0", 4);
    EXPECT_EQ(complaintAbout("a.stl", header + std::string(50, '\0')), "");
}

TEST(Completeness, FilesOfOtherFormatsPass) {
    EXPECT_EQ(complaintAbout("a.obj", "v 1 2"), "");
    EXPECT_EQ(complaintAbout("a.ply", "solid"), "");
}

}  // namespace
}  // namespace bwfirt
