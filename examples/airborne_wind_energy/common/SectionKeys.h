// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QString>
#include <QtCore/QStringList>
#include <QtCore/QVector>

#include <Eigen/Core>

#include <cstdint>
#include <functional>
#include <utility>

namespace awe {

/// The keys of one section of a plant file, and what they set.
class SectionKeys
{
public:
    /// \param section  its name, for messages
    explicit SectionKeys(const QString &section)
        : m_section(section)
    {
    }

    /// \param value  outlives this object
    void addNumber(const char *name, double *value, double smallest, double largest, const char *unit);
    /// Each constant that \a parameters visits: PlantParameters and its like.
    template<typename Parameters>
    void addConstants(Parameters *parameters)
    {
        Parameters::visitConstants(*parameters,
                                   [this](const char *name, double &value, double smallest, double largest,
                                          const char *unit) { addNumber(name, &value, smallest, largest, unit); });
    }
    void addInteger(const char *name, int *value, int smallest, int largest);
    /// An integer up to 2^53.
    void addSeed(const char *name, std::uint64_t *value);
    /// Any text. \param set  takes it
    void addText(const char *name, const std::function<void(const QString &text)> &set)
    {
        add(name, [set](const QString &text) { return set(text), QString(); });
    }
    /// Three numbers, each from -\a largest to \a largest [m/s].
    void addVector(const char *name, Eigen::Vector3d *value, double largest);
    template<typename Choice>
    void addChoice(const char *name, Choice *value, const QVector<std::pair<const char *, Choice>> &choices)
    {
        add(name, [value, choices](const QString &text) {
            QStringList words;
            for (const auto &[word, choice] : choices) {
                words << QString::fromLatin1(word);
                if (text == words.last()) {
                    *value = choice;
                    return QString();
                }
            }
            const QString last = words.takeLast();
            return QStringLiteral("use %1 or %2").arg(words.join(QStringLiteral(", ")), last);
        });
    }

    /// Sets what \a key stands for to \a value. \return empty, or what is wrong and the remedy
    QString set(const QString &key, const QString &value) const;

private:
    /// How a text becomes a value. \return empty, or what to use
    using Take = std::function<QString(const QString &text)>;

    void add(const char *name, Take take) { m_keys.append({QString::fromLatin1(name), std::move(take)}); }

    QString m_section;
    QVector<std::pair<QString, Take>> m_keys;
};

}  // namespace awe
