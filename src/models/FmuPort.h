// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "FmuExchange.h"
#include "FmuWiring.h"
#include "QPlcCompactSlaveNode.h"

namespace qplc {

/// A signal of an FMU node: a port whose elements are numbers of the FMU, each converted by a
/// factor and an offset.
class FmuPort final : public QPlcPort
{
public:
    /// What ties an element of the signal to a number of the FMU. Value of the target = value of
    /// the source * factor + offset.
    struct Wire
    {
        FmuElement number;
        double factor = 1.0;
        double offset = 0.0;
        int element = 0;  // of the signal

        bool isConverted() const { return factor != 1.0 || offset != 0.0; }
    };

    /// \param exchange  where the values of the FMU lie: its inputs for an input; outlives the port
    FmuPort(QPlcCompactSlaveNode *node, const QString &signal, Direction direction, int version, FmuExchange *exchange);
    ~FmuPort() override;

    /// Ties an element to a number. \param isArray  whether the signal is one
    /// \return false when the signal has a value for this element already, or is used with and
    ///         without brackets
    bool add(const Wire &wire, bool isArray);
    /// Elements without a number, in words; empty: it is complete.
    QString missingElements() const;
    const std::vector<Wire> &wires() const { return m_wires; }
    /// "position[2]", or the name alone
    QString elementName(int element) const;

private:
    /// How the value of a wire travels.
    struct Move
    {
        enum Way : quint8 { Copy, Whole, Real };

        Way way = Real;
        bool isBoolean = false;
        bool isChecked = false;                                  // an enumeration, which may not fit
        char *number = nullptr;                                  // in the exchange
        QPlcSignalType::Scalar scalar = QPlcSignalType::Real64;  // of it
        std::size_t offset = 0;                                  // of the element of the signal [byte]
        double factor = 1.0;
        double added = 0.0;
        const FmuVariable *variable = nullptr;

        /// Without an offset, -0 stays what it is.
        double converted(double value) const { return added == 0.0 ? value * factor : value * factor + added; }
    };

    QString variableType() const override;
    bool accepts(QPlcSignalType type) const override;
    bool accepts(const Wire &wire, QPlcSignalType::Scalar scalar) const;
    void attach(QPlcSignalType type) override;
    void load(const char *bytes) override;
    void store(char *bytes) const override;
    char *plainBytes() const override { return m_plain; }
    void carry(const Move &move, QPlcSignalType::Scalar fromScalar, const char *from, QPlcSignalType::Scalar toScalar,
               char *to) const;
    void check(const Move &move, qint64 value, QPlcSignalType::Scalar scalar) const;

    int m_version;
    FmuExchange *m_exchange;
    bool m_isArray = false;
    int m_count = 0;  // of the elements of the signal
    std::vector<Wire> m_wires;
    QPlcSignalType::Scalar m_scalar = QPlcSignalType::Invalid;  // of the signal
    std::vector<Move> m_moves;
    char *m_plain = nullptr;
};

}  // namespace qplc
