// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>

namespace qplc {

/// The keys that a person holds. What a keyboard repeats by itself is no press and no release.
class HeldKeys
{
public:
    /// \return whether anything has changed
    bool press(int key, bool isAutoRepeat) { return !isAutoRepeat && m_keys.insert(key).second; }
    bool release(int key, bool isAutoRepeat) { return !isAutoRepeat && m_keys.erase(key) > 0; }
    bool releaseAll()
    {
        const bool hadAny = !m_keys.empty();
        m_keys.clear();
        return hadAny;
    }
    bool contains(int key) const { return m_keys.count(key) > 0; }

private:
    std::set<int> m_keys;
};

}  // namespace qplc
