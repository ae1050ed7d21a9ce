// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "math/Vector.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace bwfirt {

/// A word of a text file and the line, counted from 1, on which it stands.
struct Word {
    std::string text;
    int line = 0;
    std::size_t begin = 0;  ///< of its bytes in the file, quotes included
    std::size_t end = 0;
};

/// Reads a text file word by word: words are separated by white space, '#' begins a comment that
/// runs to the end of the line, and double quotes hold a word with spaces or '#' together. Numbers
/// do not depend on the locale. Errors are std::runtime_error with "<file>:<line>: <what is
/// wrong>".
class TextReader {
  public:
    explicit TextReader(std::filesystem::path path);

    const std::filesystem::path& path() const { return path_; }

    /// The next word without taking it; nothing at the end of the file.
    const std::optional<Word>& peek() const { return next_; }

    /// Takes the next word. `key` and `expected` tell the user what is missing where there is none.
    Word take(std::string_view key, std::string_view expected);

    /// Where the bytes of the word that was taken last end; 0 before the first.
    std::size_t endOfLastWord() const { return lastWord_.end; }

    /// Takes a finite number.
    double takeNumber(std::string_view key, std::string_view expected);

    /// Takes a whole number.
    std::int64_t takeInteger(std::string_view key, std::string_view expected);

    /// "<file>:<line>: <what>"
    [[noreturn]] void fail(int line, const std::string& what) const;

    /// "<file>:<line>: <key>: expected <expected>, not '<found>'"
    [[noreturn]] void failExpected(const Word& found, std::string_view key,
                                   std::string_view expected) const;

  private:
    void advance();

    std::filesystem::path path_;
    std::string content_;
    std::size_t position_ = 0;
    int line_ = 1;
    Word lastWord_{"", 1, 0, 0};
    std::optional<Word> next_;
};

/// The text as comment lines of a file.
std::string asComment(const std::string& text);

/// A text as it may stand in a message of one line, whatever bytes it holds: cut where it is longer
/// than `longest`, '?' for every byte that is not printable ASCII.
std::string printable(std::string_view text, std::size_t longest = 40);

/// The finite number that the whole text is; nothing where it is something else.
std::optional<double> parseNumber(std::string_view text);

/// The shortest text from which parseNumber gives back this very number.
std::string formatNumber(double value);

/// The three numbers, separated by spaces.
std::string formatNumbers(const V3d& v);

}  // namespace bwfirt
