// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QtGlobal>

#include <algorithm>
#include <map>

namespace qplc {

/// The keys that a person holds. What a keyboard repeats by itself is no press and no release.
///
/// What a key means changes while it is held: the 4 of the keypad is Left or 4, as Shift is. So a
/// key is known by its place on the keyboard, and released as what it was pressed as.
class HeldKeys
{
public:
    /// \param place  QKeyEvent::nativeScanCode(); 0: not known, so that the key has to do
    /// \return whether anything has changed
    bool press(int key, bool isAutoRepeat, quint32 place = 0)
    {
        return !isAutoRepeat && m_keys.emplace(idOf(key, place), key).second;
    }
    bool release(int key, bool isAutoRepeat, quint32 place = 0)
    {
        return !isAutoRepeat && m_keys.erase(idOf(key, place)) > 0;
    }
    bool releaseAll()
    {
        const bool hadAny = !m_keys.empty();
        m_keys.clear();
        return hadAny;
    }
    bool contains(int key) const
    {
        return std::any_of(m_keys.begin(), m_keys.end(), [key](const auto &held) { return held.second == key; });
    }

private:
    static qint64 idOf(int key, quint32 place) { return place != 0 ? -qint64(place) : qint64(key); }

    std::map<qint64, int> m_keys;  // what they meant when they were pressed
};

}  // namespace qplc
