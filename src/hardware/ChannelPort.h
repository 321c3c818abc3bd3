// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "DriverRunner.h"
#include "QPlcCompactSlaveNode.h"

namespace qplc {

/// A signal of a hardware node: a port whose elements are channels of devices, each converted by a factor and an offset.
class ChannelPort final : public QPlcPort
{
public:
    struct Element
    {
        DriverRunner *runner = nullptr;
        int channel = -1;  // its number at the runner; -1: there is none
        double factor = 1.0;
        double offset = 0.0;
    };

    ChannelPort(QPlcCompactSlaveNode *node, const QString &signal, Direction direction);
    ~ChannelPort() override;

    /// \param index  of an array; -1: the signal is none
    /// \return false when the signal has this element already, or is used with and without brackets
    bool add(int index, const Element &element);
    const std::vector<Element> &elements() const { return m_elements; }
    /// "acceleration[2]", or the name alone
    QString elementName(std::size_t index) const;
    /// Elements that have no channel, in words; empty: it is complete.
    QString missingElements() const;

    /// Takes the newest values of the channels, and how far they can be trusted.
    void refresh(qint64 now) noexcept;
    /// Gives the value of each element of \a value, which is the safe one of the signal, to its channel.
    void setSafe(const QPlcValue &value) noexcept;
    /// Gives the values that were set last to the channels.
    void pass(bool isSafe) noexcept;

private:
    QString variableType() const override;
    bool accepts(QPlcSignalType type) const override;
    void attach(QPlcSignalType type) override { m_type = type; }
    void load(const char *bytes) override;
    void store(char *bytes) const override;
    QPlcSignalType m_type;
    bool m_isArray = false;
    std::vector<Element> m_elements;
    std::vector<double> m_values;
};

}  // namespace qplc
