// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcCompactSlaveNode.h"

#include <QtCore/QVector>

#include <array>
#include <chrono>
#include <cstring>
#include <limits>
#include <memory>
#include <type_traits>

/// Base of the nodes that the CMake function `qtplc_add_simulink_node()` generates from code that
/// Simulink has exported. It has what does not depend on the model; the generated class adds one
/// port for each root inport and outport, and calls the functions of the model.
///
/// A program with such a node, in short (the generated header is called as the target of the node):
///
/// \code
/// class WinchModel : public QPlcSimulinkNode
/// {
/// public:
///     WinchModel() : QPlcSimulinkNode("Winch", std::chrono::milliseconds(10)) {}
/// };
///
/// std::unique_ptr<QPlcSimulinkNode> make_winch_model()
/// {
///     return std::make_unique<WinchModel>();
/// }
///
/// int main(int argc, char **argv)
/// {
///     return QPlcSimulinkNode::run(argc, argv, make_winch_model);
/// }
/// \endcode
///
/// The node computes one step of the model in each cycle. With a period other than sampleTime() its
/// first step is a fault. When the model reports an error or asks for the end of the simulation,
/// the node asks for a safe stop (QPlcSlaveNode::requestSafeStop()) and fails with that text.
///
/// \threadsafe no: see QPlcCompactSlaveNode
///
/// \ingroup nodes
class QTPLC_EXPORT QPlcSimulinkNode : public QPlcCompactSlaveNode
{
    Q_OBJECT
public:
    /// Ends the cycles of the node, as the destructor of QPlcCompactSlaveNode does.
    ~QPlcSimulinkNode() override;

    /// Returns the period for which the code of the model was generated.
    std::chrono::nanoseconds sampleTime() const { return m_sampleTime; }
    /// Returns the part of a signal table that has the signals of this node, with types and
    /// descriptions, as INI text. Units are unknown to the exported code: add them.
    QString table() const;
    /// Reads values of tunable parameters, in the section `[parameters]` of an INI file. An array
    /// has its values one after the other, separated by commas or spaces; a matrix column by
    /// column, as MATLAB stores it. They take effect at the next initialization; parameters that
    /// the file does not name keep their values.
    /// \param fileName  INI file, at most 16 MiB; other sections are for other readers
    /// \param error  gets file, line and remedy of each mistake; not null
    /// \return false when something is wrong; the parameters then have not changed
    bool readParameters(const QString &fileName, QString *error);

    /// Makes a node.
    using Maker = std::unique_ptr<QPlcSimulinkNode> (*)();
    /// Does all of a program for one node, with the options of QPlcNodeApplication, and `--table`
    /// (prints table() and ends) and `--parameters FILE` (readParameters()).
    /// \return the exit code of the program
    static int run(int argc, char **argv, Maker make);

protected:
    /// Makes a node that is not connected.
    /// \param name  under which the node registers
    /// \param sampleTime  of the exported code, 10 us to 10 s
    QPlcSimulinkNode(const QString &name, std::chrono::nanoseconds sampleTime);

    /// The numbers of an array of the model, in the order of the signal table.
    template<typename Variable>
    using Values = std::array<std::remove_all_extents_t<Variable>,
                              sizeof(Variable) / sizeof(std::remove_all_extents_t<Variable>)>;
    /// The truth values of a variable of the model.
    template<typename Variable>
    using Truths = std::array<bool, sizeof(Variable) / sizeof(std::remove_all_extents_t<Variable>)>;

    /// Adds a signal to table().
    /// \param name  of the signal; copied
    /// \param description  for the table; copied
    /// \param values  names of the enumerators: "0: Off, 1: On"; empty: none; copied
    template<typename Variable>
    void addSignal(const char *name, const char *description, const char *values = "")
    {
        using Shape = QPlcPortDetail::Shape<Variable>;
        using Element = typename QPlcPortDetail::Number<typename Shape::Element>::Type;
        addSignal(name, QPlcSignalType(QPlcPortDetail::scalarOf<Element>(), Shape::count),
                  std::is_same_v<Element, bool>, description, values);
    }
    /// Offers a variable of the model to readParameters().
    /// \param name  under which the file has it; copied
    /// \param variable  a number or an array of numbers; outlives the node
    template<typename Variable>
    void addParameter(const char *name, Variable &variable)
    {
        using Element = std::remove_all_extents_t<Variable>;
        addParameter(name, {&variable, sizeof(Variable) / sizeof(Element), &holds<Element>, &store<Element>});
    }
    /// Writes the values of readParameters() into the model. Call it before its initialization.
    void setParameters();
    /// Throws unless the master has the period of the model.
    void requirePeriod(const QPlcCycle &cycle) const
    {
        if (cycle.period() != m_sampleTime)
            refusePeriod(cycle);
    }
    /// Asks for a safe stop and throws if the model has an error or wants to end.
    /// \param errorStatus  rtmGetErrorStatus(); null: no error
    /// \param stopRequested  rtmGetStopRequested()
    void requireGoingOn(const char *errorStatus, bool stopRequested)
    {
        if (errorStatus || stopRequested)
            end(errorStatus);
    }

    /// Copies all elements of an array of another shape.
    template<typename To, typename From>
    static void copy(To &to, const From &from)
    {
        static_assert(sizeof(To) == sizeof(From));
        std::memcpy(&to, &from, sizeof(To));
    }
    /// Copies truth values, whose type the exported code may have as a number.
    template<typename Variable>
    static void fromTruths(Variable &to, const Truths<Variable> &from)
    {
        auto *elements = reinterpret_cast<std::remove_all_extents_t<Variable> *>(&to);
        for (std::size_t i = 0; i < from.size(); ++i)
            elements[i] = from[i];
    }
    /// The other direction.
    template<typename Variable>
    static Truths<Variable> toTruths(const Variable &from)
    {
        Truths<Variable> to{};
        const auto *elements = reinterpret_cast<const std::remove_all_extents_t<Variable> *>(&from);
        for (std::size_t i = 0; i < to.size(); ++i)
            to[i] = elements[i] != 0;
        return to;
    }
    /// Copies a matrix that is stored row by row into one that is stored column by column. The
    /// other direction is the same with rows and columns exchanged.
    template<typename To, typename From>
    static void transpose(To &to, const From &from, int rows, int columns)
    {
        static_assert(sizeof(To) == sizeof(From));
        for (int row = 0; row < rows; ++row)
            for (int column = 0; column < columns; ++column)
                to[column * rows + row] = from[row * columns + column];
    }

private:
    struct Signal
    {
        QString name;
        QString type;
        QString description;
        QString values;
    };
    struct Parameter
    {
        void *variable;
        std::size_t count;
        bool (*holds)(double);
        void (*store)(void *, std::size_t, double);
        QString name = {};
        QVector<double> values = {};  // empty: keeps what the model has
    };

    template<typename Element>
    static bool holds(double value)
    {
        using Number = typename QPlcPortDetail::Number<Element>::Type;
        if constexpr (std::is_floating_point_v<Number>)
            return true;
        else  // whole, and in its range
            return value >= double(std::numeric_limits<Number>::lowest())
                && value <= double(std::numeric_limits<Number>::max()) && double(Number(value)) == value;
    }
    template<typename Element>
    static void store(void *variable, std::size_t index, double value)
    {
        static_cast<Element *>(variable)[index] = static_cast<Element>(value);
    }
    void addSignal(const char *name, QPlcSignalType type, bool isBool, const char *description, const char *values);
    void addParameter(const char *name, Parameter parameter);
    static QString valueMistake(const QString &text, Parameter *parameter);
    [[noreturn]] void refusePeriod(const QPlcCycle &cycle) const;
    [[noreturn]] void end(const char *errorStatus);

    const std::chrono::nanoseconds m_sampleTime;
    QVector<Signal> m_signals;
    QVector<Parameter> m_parameters;
};
