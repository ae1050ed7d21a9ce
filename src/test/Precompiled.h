// SPDX-License-Identifier: GPL-3.0-only
/// @file What most files include, and what takes longest to read of it.
#pragma once

#include "kernel/RTKernel.h"
#include "scene/Scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <map>
#include <memory>
#include <optional>
#include <random>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>
