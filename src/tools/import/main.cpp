// SPDX-License-Identifier: GPL-3.0-only

// Turns a model into a scene. assimp reads the model in a process of its own, since damaged and
// hostile files crash it, exhaust the memory or keep it busy for ever: whatever happens there, this
// process says it in one line and leaves no file behind.

#include "report/BuildInfo.h"
#include "scene/FileIO.h"
#include "scene/TextReader.h"
#include "tools/import/Apart.h"
#include "tools/import/Completeness.h"
#include "tools/import/Model.h"
#include "tools/import/Outputs.h"
#include "tools/import/Summary.h"

#include <iostream>
#include <new>

namespace {

using namespace bwfirt;

constexpr int DONE = 0, FAILED = 1, WRONG_USAGE = 2;
constexpr std::size_t LONGEST_NAME = 200;

/// Reads, converts and writes; the summary.
std::string import(const ImportSettings& settings, const Outputs& outputs) {
    requireComplete(settings.model);
    auto model = std::make_unique<Model>(settings.model);
    Conversion conversion = converted(*model, settings);
    const std::string text = summary(*model, conversion);
    model.reset();  // its memory is worth more than that of the triangles
    outputs.write(conversion, "made from " +
                                  printable(settings.model.filename().string(), LONGEST_NAME) +
                                  " by bwfirt-import " + BuildInfo::VERSION + "\n" +
                                  formula(conversion.placement) + "\n");
    return text;
}

void run(const ImportSettings& settings) {
    holdInterrupts();
    inputFileSize(settings.model);
    const Outputs outputs(settings.base);
    outputs.check(settings.model);
    std::string text = runApart(settings.model.string(), [&] { return import(settings, outputs); });
    const std::string base = settings.base.string();
    text += "written      " + base + ".ra2, " + base + ".camera, " + base + ".scene\n";
    if (!(std::cout << text << std::flush))
        throw std::runtime_error("standard output: cannot be written");
    outputs.publish();
}

int complain(const std::string& message, int status) {
    std::cerr << "bwfirt-import: " << message << std::endl;
    return status;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        if (const std::optional<ImportSettings> settings = parseImportCommandLine(argc, argv))
            run(*settings);
        return DONE;
    } catch (const ImportUsageError& error) {
        return complain(error.what(), WRONG_USAGE);
    } catch (const std::bad_alloc&) {
        return complain("not enough memory", FAILED);
    } catch (const std::exception& error) {
        return complain(error.what(), FAILED);
    }
}
