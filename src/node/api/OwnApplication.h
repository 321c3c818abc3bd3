// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace qplc {

/// Somebody who needs a QCoreApplication in a program that may have none. The first one makes it,
/// in a thread of its own, and the last one ends both.
class OwnApplication
{
public:
    OwnApplication();
    ~OwnApplication();
    OwnApplication(const OwnApplication &) = delete;
    OwnApplication &operator=(const OwnApplication &) = delete;
};

}  // namespace qplc
