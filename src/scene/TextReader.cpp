// SPDX-License-Identifier: GPL-3.0-only
#include "scene/TextReader.h"

#include "scene/FileIO.h"

#include <array>
#include <charconv>
#include <cmath>
#include <sstream>
#include <stdexcept>

namespace bwfirt {

namespace {

bool isSpace(char c) {
    return c == ' ' || (c >= '\t' && c <= '\r');
}

/// from_chars over the whole text, with the leading '+' that it does not take itself.
template <typename T>
std::optional<T> parse(std::string_view text) {
    if (text.starts_with('+') && !text.starts_with("+-"))
        text.remove_prefix(1);
    T value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size())
        return std::nullopt;
    return value;
}

}  // namespace

TextReader::TextReader(std::filesystem::path path)
    : path_(std::move(path)), content_(readTextFile(path_)) {
    advance();
}

Word TextReader::take(std::string_view key, std::string_view expected) {
    if (!next_)
        fail(lastWord_.line, std::string(key) + ": expected " + std::string(expected) +
                                 ", not the end of the file");
    lastWord_ = std::move(*next_);
    advance();
    return lastWord_;
}

double TextReader::takeNumber(std::string_view key, std::string_view expected) {
    const Word word = take(key, expected);
    const std::optional<double> number = parseNumber(word.text);
    if (!number)
        failExpected(word, key, expected);
    return *number;
}

std::int64_t TextReader::takeInteger(std::string_view key, std::string_view expected) {
    const Word word = take(key, expected);
    const std::optional<std::int64_t> number = parse<std::int64_t>(word.text);
    if (!number)
        failExpected(word, key, expected);
    return *number;
}

void TextReader::fail(int line, const std::string& what) const {
    throw std::runtime_error(path_.string() + ":" + std::to_string(line) + ": " + what);
}

void TextReader::failExpected(const Word& found, std::string_view key,
                              std::string_view expected) const {
    fail(found.line, printable(key) + ": expected " + std::string(expected) + ", not '" +
                         printable(found.text) + "'");
}

void TextReader::advance() {
    next_.reset();
    const std::string_view text = content_;
    while (position_ < text.size() && (isSpace(text[position_]) || text[position_] == '#')) {
        if (text[position_] == '#')
            position_ = std::min(text.find('\n', position_), text.size());
        else if (text[position_++] == '\n')
            ++line_;
    }
    if (position_ == text.size())
        return;

    const bool quoted = text[position_] == '"';
    const std::size_t begin = position_ + (quoted ? 1 : 0);
    std::size_t end = begin;
    while (end < text.size() && text[end] != '\n' &&
           (quoted ? text[end] != '"' : !isSpace(text[end]) && text[end] != '#'))
        ++end;
    if (quoted && (end == text.size() || text[end] != '"'))
        fail(line_, "expected a closing '\"' on the same line");
    const std::size_t wordBegin = position_;
    position_ = end + (quoted ? 1 : 0);
    next_ = Word{std::string(text.substr(begin, end - begin)), line_, wordBegin, position_};
}

std::string asComment(const std::string& text) {
    std::istringstream lines(text);
    std::string comment;
    for (std::string line; std::getline(lines, line);)
        comment += "# " + line + "\n";
    return comment;
}

std::string printable(std::string_view text, std::size_t longest) {
    std::string result(text.substr(0, longest));
    for (char& c : result)
        if (c < ' ' || c > '~')
            c = '?';
    return text.size() > longest ? result + "..." : result;
}

std::optional<double> parseNumber(std::string_view text) {
    const std::optional<double> number = parse<double>(text);
    return number && std::isfinite(*number) ? number : std::nullopt;
}

std::string formatNumber(double value) {
    std::array<char, 32> buffer{};
    const auto result = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
    return std::string(buffer.data(), result.ptr);
}

std::string formatNumbers(const V3d& v) {
    return formatNumber(v.x) + " " + formatNumber(v.y) + " " + formatNumber(v.z);
}

}  // namespace bwfirt
