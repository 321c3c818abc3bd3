// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcInputTiming.h"
#include "QPlcQuality.h"
#include "QPlcSignalType.h"

#include <QtCore/QString>

#include <array>
#include <cstring>
#include <type_traits>

class QPlcCompactSlaveNode;

/// Base of all ports. A port is a variable of a node that belongs to a signal: QPlcInput,
/// QPlcOutput, QPlcBoundInput, QPlcBoundOutput, QPlcCompactSignal.
///
/// \code
/// class Winch : public QPlcCompactSlaveNode
/// {
/// public:
///     Winch() : QPlcCompactSlaveNode("Winch") {}
///
/// private:
///     QPlcInput<double> m_speed{this, "tetherSpeed"};                                   // [m/s]
///     QPlcInput<double> m_wind{this, "windSpeed", QPlcInputTiming::SameCycle};          // [m/s]
///     QPlcOutput<double> m_length{this, "tetherLength"};                                // [m]
/// };
/// \endcode
///
/// A port registers itself at its node in its constructor. You can neither copy nor move it. The
/// node does not own its ports. The registration at the master fails if the signal does not exist
/// or its type does not fit; one message lists all such ports.
///
/// \threadsafe no: the cycle thread uses ports while cycles run; at other times use them in the
///     thread of the node. Destroying a port ends the cycles of its node
///
/// \ingroup nodes
class QTPLC_EXPORT QPlcPort
{
public:
    /// Direction of the value, as the node sees it.
    enum Direction : quint8 {
        Input,  ///< the node reads the signal
        Output  ///< the node writes the signal
    };

    QPlcPort(const QPlcPort &) = delete;
    QPlcPort &operator=(const QPlcPort &) = delete;

    /// Returns the name of the signal.
    QString name() const { return m_name; }
    /// Returns whether the node reads or writes the signal.
    Direction direction() const { return m_direction; }
    /// Returns true if the node reads the signal.
    bool isInput() const { return m_direction == Input; }
    /// Returns the quality of the value. Of an input it is Invalid unless the node receives
    /// qualities (QPlcSlaveNode::setReceivesQuality()). Of an output it is the quality that the
    /// node has set.
    QPlcQuality quality() const { return m_quality ? QPlcQuality::fromByte(quint8(*m_quality)) : QPlcQuality(); }
    /// Returns true for an input that was declared with QPlcInputTiming::SameCycle.
    bool isSameCycle() const { return isInput() && m_timing == QPlcInputTiming::SameCycle; }

protected:
    /// Registers the port at its node.
    /// \param node  outlives the port; not null, and not registered at a master yet
    /// \param name  of the signal, UTF-8; copied
    /// \param direction  Input or Output
    /// \param timing  of an input; an output ignores it
    QPlcPort(QPlcCompactSlaveNode *node, const char *name, Direction direction,
             QPlcInputTiming::Value timing = QPlcInputTiming::LastCycle);
    /// Calls leaveNode().
    virtual ~QPlcPort();
    /// Ends the cycles of the node and removes the port from it. The destructor of a derived port
    /// calls this first, while its variable still exists. Does nothing the second time.
    void leaveNode();
    /// Sets the quality that other nodes receive with the value of this output.
    void giveQuality(QPlcQuality quality) { m_given = char(quality.toByte()); }

private:
    friend class QPlcCompactSlaveNode;
    /// Type of the variable in words, for messages: "double[3]".
    virtual QString variableType() const = 0;
    /// Whether the variable can hold every value of \a type (input), or the signal every value of
    /// the variable up to rounding (output).
    virtual bool accepts(QPlcSignalType type) const = 0;
    /// From now on load() and store() use values of \a type.
    /// \pre accepts(type)
    virtual void attach(QPlcSignalType type) = 0;
    virtual void load(const char *bytes) = 0;
    virtual void store(char *bytes) const = 0;
    /// Returns the place of the variable if its bytes are those of the frame, so that a copy
    /// replaces load() and store(); else null.
    /// \pre attached
    virtual char *plainBytes() const { return nullptr; }

    QPlcCompactSlaveNode *m_node = nullptr;
    QString m_name;
    Direction m_direction;
    QPlcInputTiming::Value m_timing;
    const char *m_quality = nullptr;                               // where its byte lies
    char m_given = char(QPlcQuality(QPlcQuality::Good).toByte());  // of an output
};

namespace QPlcPortDetail {

// Numbers, truth values and enumerators.
template<typename T>
constexpr bool isElement = std::is_arithmetic_v<T> || std::is_enum_v<T>;

// The number that an element is on the wire: of an enumerator that of its underlying type.
template<typename T, bool isEnum = std::is_enum_v<T>>
struct Number
{
    using Type = T;
};

template<typename T>
struct Number<T, true>
{
    using Type = std::underlying_type_t<T>;
};

// Shape of a variable: the type and the number of its elements.
template<typename T, typename = void>
struct Shape;

template<typename T>
struct Shape<T, std::enable_if_t<isElement<T>>>
{
    using Element = T;
    static constexpr int count = 1;
    static Element *data(T &value) { return &value; }
};

template<typename T, std::size_t N>
struct Shape<T[N], std::enable_if_t<isElement<T>>>
{
    using Element = T;
    static constexpr int count = int(N);
    static Element *data(T (&value)[N]) { return value; }
};

template<typename T, std::size_t N>
struct Shape<std::array<T, N>, std::enable_if_t<isElement<T>>>
{
    using Element = T;
    static constexpr int count = int(N);
    static Element *data(std::array<T, N> &value) { return value.data(); }
};

// Fixed-size vectors of Eigen, without including Eigen.
template<typename T>
struct Shape<T, std::enable_if_t<(T::SizeAtCompileTime > 0) && std::is_arithmetic_v<typename T::Scalar>>>
{
    using Element = typename T::Scalar;
    static constexpr int count = int(T::SizeAtCompileTime);
    static Element *data(T &value) { return value.data(); }
};

template<typename Element>
constexpr QPlcSignalType::Scalar scalarOf()
{
    if constexpr (std::is_same_v<Element, bool>)
        return QPlcSignalType::Int8;
    else if constexpr (std::is_floating_point_v<Element>)
        return sizeof(Element) == 4 ? QPlcSignalType::Real32 : QPlcSignalType::Real64;
    else if constexpr (std::is_signed_v<Element>)
        return sizeof(Element) == 1 ? QPlcSignalType::Int8
            : sizeof(Element) == 2  ? QPlcSignalType::Int16
            : sizeof(Element) == 4  ? QPlcSignalType::Int32
                                    : QPlcSignalType::Int64;
    else
        return sizeof(Element) == 1 ? QPlcSignalType::UInt8
            : sizeof(Element) == 2  ? QPlcSignalType::UInt16
            : sizeof(Element) == 4  ? QPlcSignalType::UInt32
                                    : QPlcSignalType::UInt64;
}

/// Copies \a count packed little-endian numbers of the kind \a scalar to or from numbers of this
/// machine.
template<typename Element>
QTPLC_EXPORT void loadElements(QPlcSignalType::Scalar scalar, const char *bytes, Element *elements, int count);
template<typename Element>
QTPLC_EXPORT void storeElements(QPlcSignalType::Scalar scalar, char *bytes, const Element *elements, int count);

/// Whether a variable with elements of the kind \a variable can be an input or output of a signal
/// with elements of the kind \a wire: reals mix, integers may become wider in the direction of the
/// value, truth values fit Int8 and UInt8, times fit Int64.
QTPLC_EXPORT bool fits(QPlcSignalType::Scalar variable, bool isBool, QPlcSignalType::Scalar wire,
                       QPlcPort::Direction direction);
QTPLC_EXPORT QString describe(QPlcSignalType::Scalar scalar, bool isBool, int count);

/// A port whose value lies in a variable of type T.
template<typename T>
class VariablePort : public QPlcPort
{
    using S = Shape<T>;
    using Element = typename Number<typename S::Element>::Type;
    static constexpr bool isBool = std::is_same_v<Element, bool>;
    static constexpr bool isEnum = std::is_enum_v<typename S::Element>;

protected:
    VariablePort(QPlcCompactSlaveNode *node, const char *name, Direction direction, T *variable,
                 QPlcInputTiming::Value timing = QPlcInputTiming::LastCycle)
        : QPlcPort(node, name, direction, timing)
        , m_variable(variable)
    {
    }

private:
    QString variableType() const final { return describe(scalarOf<Element>(), isBool, S::count); }
    bool accepts(QPlcSignalType type) const final
    {
        return type.count() == S::count && fits(scalarOf<Element>(), isBool, type.scalar(), direction());
    }
    void attach(QPlcSignalType type) final { m_wire = type.scalar(); }
    void load(const char *bytes) final
    {
        if constexpr (isEnum) {  // an enumerator must not be accessed as the number that it is
            Element numbers[S::count];
            loadElements(m_wire, bytes, numbers, S::count);
            std::memcpy(S::data(*m_variable), numbers, sizeof numbers);
        } else {
            loadElements(m_wire, bytes, S::data(*m_variable), S::count);
        }
    }
    void store(char *bytes) const final
    {
        if constexpr (isEnum) {
            Element numbers[S::count];
            std::memcpy(numbers, S::data(*m_variable), sizeof numbers);
            storeElements(m_wire, bytes, numbers, S::count);
        } else {
            storeElements(m_wire, bytes, S::data(*m_variable), S::count);
        }
    }
    char *plainBytes() const final
    {
        const bool isPlain = m_wire == scalarOf<Element>() && !isBool && Q_BYTE_ORDER == Q_LITTLE_ENDIAN;
        return isPlain ? reinterpret_cast<char *>(S::data(*m_variable)) : nullptr;
    }

    T *m_variable;
    QPlcSignalType::Scalar m_wire = QPlcSignalType::Invalid;
};

}  // namespace QPlcPortDetail
