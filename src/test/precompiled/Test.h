// SPDX-License-Identifier: GPL-3.0-only
/// @file What most tests include, and what takes longest to read of it.
#pragma once

#include "test/precompiled/Framework.h"

#include <gtest/gtest.h>
