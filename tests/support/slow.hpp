// The mark of tests that take the address sanitizer 3 s to minutes and go nowhere that shorter ones
// do not: it stands first in them, and has them skipped there.
#pragma once

#include <gtest/gtest.h>

#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define HAVERS_SLOW GTEST_SKIP() << "slow under the address sanitizer"
#endif
#endif
#ifndef HAVERS_SLOW
#define HAVERS_SLOW static_cast<void>(0)
#endif
