// SPDX-License-Identifier: GPL-3.0-only
/// @file What most of the framework's files include, and what takes longest to read of it.
#pragma once

#include "scene/Scene.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>
