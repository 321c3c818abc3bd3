// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QJsonObject>
#include <QtCore/QStringList>

#include <initializer_list>

namespace qplc {

/// The settings of a panel as its layout has them: what nobody changes goes back to the file byte
/// for byte, and what a person sets back to its default leaves it. A value type.
class PanelSettings
{
public:
    /// \param keys  that the panel knows
    PanelSettings(std::initializer_list<const char *> keys)
    {
        for (const char *key : keys)
            m_keys << QLatin1String(key);
    }

    /// Takes over all keys that the panel knows; those that are missing have their defaults from
    /// here on.
    /// \return the others
    QJsonObject take(QJsonObject settings)
    {
        m_values = QJsonObject();
        for (const QString &key : m_keys) {
            if (settings.contains(key))
                m_values.insert(key, settings.take(key));
        }
        return settings;
    }

    QJsonValue value(const char *key) const { return m_values.value(QLatin1String(key)); }

    /// \return whether it is another value than before
    bool set(const char *key, const QJsonValue &value, const QJsonValue &defaultValue = QJsonValue())
    {
        const QJsonObject before = m_values;
        if (value == defaultValue || value.isNull() || value.isUndefined())
            m_values.remove(QLatin1String(key));
        else
            m_values.insert(QLatin1String(key), value);
        return m_values != before;
    }

    /// All values that are no defaults.
    const QJsonObject &toJson() const { return m_values; }

private:
    QStringList m_keys;
    QJsonObject m_values;
};

}  // namespace qplc
