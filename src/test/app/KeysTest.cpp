// SPDX-License-Identifier: GPL-3.0-only
#include "app/viewer/Keys.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

namespace bwfirt {
namespace {

std::map<std::pair<std::string, bool>, Command> bindingsOf(bool dvorak) {
    std::map<std::pair<std::string, bool>, Command> bindings;
    for (const KeyRow& row : keyTable(dvorak))
        for (const KeyBinding& binding : row.bindings)
            EXPECT_TRUE(
                bindings.emplace(std::pair(binding.key, binding.withControl), binding.command)
                    .second)
                << binding.key << " does two things";
    return bindings;
}

TEST(Keys, EveryCommandHasAKeyAndNoKeyTwoCommands) {
    for (const bool dvorak : {false, true}) {
        std::map<Command, int> keysOf;
        for (const auto& [key, command] : bindingsOf(dvorak))
            ++keysOf[command];
        EXPECT_EQ(keysOf.size(), static_cast<std::size_t>(Command::QUIT) + 1);
    }
}

TEST(Keys, DvorakMovesWithTheKeysThatLieWhereWasdqeAre) {
    auto qwerty = bindingsOf(false), dvorak = bindingsOf(true);
    for (const auto& [here, there] :
         {std::pair("w", ","), {"a", "a"}, {"s", "o"}, {"d", "e"}, {"q", "'"}, {"e", "."}})
        EXPECT_EQ(qwerty.at({here, false}), dvorak.at({there, false})) << here;
    EXPECT_EQ(dvorak.at({"s", true}), Command::SAVE_SCENE);
}

TEST(Keys, TheHelpHasALineForEachRow) {
    const std::vector<KeyRow> table = keyTable(false);
    const std::string help = keyHelp(table);
    EXPECT_EQ(static_cast<std::size_t>(std::count(help.begin(), help.end(), '\n')), table.size());
    for (const KeyRow& row : table)
        EXPECT_NE(help.find("  " + row.keys + "  "), std::string::npos) << row.keys;
}

}  // namespace
}  // namespace bwfirt
