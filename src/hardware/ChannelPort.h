// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "DriverRunner.h"
#include "QPlcCompactSlaveNode.h"

namespace qplc {

/// A signal of a hardware node: a port whose elements are channels of devices, each converted by a
/// factor and an offset.
class ChannelPort final : public QPlcPort
{
public:
    /// What ties an element of the signal to a channel.
    struct Wire
    {
        DriverRunner *runner = nullptr;
        int channel = -1;  // its number at the runner
        double factor = 1.0;
        double offset = 0.0;
        std::size_t element = 0;
    };

    ChannelPort(QPlcCompactSlaveNode *node, const QString &signal, Direction direction);
    ~ChannelPort() override;

    /// Ties an element to a channel. What is written may go to several of them, what is read comes
    /// from one.
    /// \param index  of an array; -1: the signal is none
    /// \return false when the signal has a value for this element already, or is used with and
    ///         without brackets
    bool add(int index, Wire wire);
    const std::vector<Wire> &wires() const { return m_wires; }
    /// "acceleration[2]", or the name alone
    QString elementName(std::size_t index) const;
    /// Elements that have no channel, in words; empty: it is complete.
    QString missingElements() const;

    /// Takes the newest values of the channels, and how far they can be trusted.
    void refresh(qint64 now) noexcept;
    /// Gives the value of each element of \a value, which is the safe one of the signal, to its
    /// channel.
    void setSafe(const QPlcValue &value) noexcept;
    /// Gives the values that were set last to the channels.
    void pass(bool isSafe) noexcept;

private:
    QString variableType() const override;
    bool accepts(QPlcSignalType type) const override;
    void attach(QPlcSignalType type) override { m_type = type; }
    void load(const char *bytes) override;
    void store(char *bytes) const override;
    bool isWired(std::size_t element) const;
    QPlcSignalType m_type;
    bool m_isArray = false;
    std::vector<Wire> m_wires;
    std::vector<double> m_values;  // of the elements
};

}  // namespace qplc
