// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcSimulator.h"
#include "QPlcSlaveNode.h"
#include "QPlcUnderlyingProtocol.h"

#include <memory>
#include <type_traits>
#include <typeinfo>
#include <utility>

namespace qplc {
class SimulatedHost;
}

/// A computer in a QPlcSimulator with one program on it: a master, a node or a tool.
///
/// \code
/// class Winch : public QPlcCompactSlaveNode
/// {
/// public:
///     Winch() : QPlcCompactSlaveNode("Winch") {}
/// };
/// QPlcSimulator::run(1, [](QPlcSimulator &simulator) {
///     QPlcSimulatedHost masterHost(simulator, "master");
///     auto *master = masterHost.start<QPlcMasterNode>();
///     masterHost.call([&] { master->startServer(masterHost.place()); });
///     QPlcSimulatedHost winchHost(simulator, "winch");
///     auto *winch = winchHost.start<Winch>();
///     winchHost.call([&] { winch->connectToMaster(masterHost.place()); });
///     simulator.runFor(std::chrono::seconds(10));
///     winchHost.kill();          // like kill -9
///     winchHost.start<Winch>();  // the program starts again
/// });
/// \endcode
///
/// Call all functions of the objects of a program inside of call(): there the thread is on this
/// host, with its clocks, its network and its random numbers. Functions that only return a value
/// may be called from outside. A master, node or tool that connects, listens or starts cycles
/// outside ends the test program with a message.
///
/// Frames between simulated hosts travel over "sim://", as place() says. A node that connects with
/// another transport, such as "tcp://", reports QPlcSlaveNode::OptionError and lists those that it
/// can use.
///
/// As a process does, each program begins without a signal table of its own and without security:
/// QPlcSignalIndexTable::current() and QPlcSecurity::current() are those of the program.
///
/// \threadsafe no: call all functions in the thread in which QPlcSimulator::run() calls the
///     scenario
///
/// \ingroup test
class QPlcSimulatedHost
{
public:
    /// What happens to the connections of a program that is killed.
    enum End {
        Program,  ///< the kernel of the host keeps running and tells the other ends
        Power     ///< the other ends hear nothing
    };

    /// Makes a host without a program.
    /// \param simulator  outlives the host
    /// \param name  of the host; its random numbers follow from the seed, the name and the address
    /// \pre the simulator has had fewer than 200 hosts; one more ends the test program with a
    ///     message
    QPlcSimulatedHost(QPlcSimulator &simulator, const QString &name);
    /// Kills the program, as if power were lost.
    ~QPlcSimulatedHost();
    QPlcSimulatedHost(const QPlcSimulatedHost &) = delete;
    QPlcSimulatedHost &operator=(const QPlcSimulatedHost &) = delete;

    /// Returns the name of the host.
    QString name() const;
    /// Returns the address for a master on this host and for nodes that connect to it:
    /// "sim://127.0.1.1:50000".
    QPlcUnderlyingProtocol place() const;

    /// Kills the program that runs, and makes a \a Type(arguments ...) on this host.
    /// \return the object; the host owns it until kill()
    template<typename Type, typename... Arguments>
    Type *start(Arguments &&...arguments)
    {
        std::shared_ptr<Type> program;
        startProgram(typeid(Type), [&] { return program = makeProgram<Type>(std::forward<Arguments>(arguments)...); });
        return program.get();
    }
    /// Returns what start() has made; null: no program runs.
    /// \pre start() was called with the same \a Type: another one, even a base of it, ends the test
    ///      program with a message
    template<typename Type>
    Type *program() const
    {
        return static_cast<Type *>(programOf(typeid(Type)));
    }
    /// Returns true if start() has made a program that was not killed.
    bool isRunning() const { return m_program; }
    /// Runs \a code on this host.
    void call(const std::function<void()> &code);
    /// Begins \a code on a thread of its own on this host, and returns at once. There it may call
    /// QPlcMasterNode::step(), which waits for other hosts; it runs while virtual time passes.
    /// \param code  has to return when step() returns Stopped or SafeStop: kill() waits for that
    /// \pre a program runs
    void startThread(const std::function<void()> &code);

    /// Ends the program. What its objects do while they are destroyed does not reach the network.
    /// \param end  what happens to its connections
    void kill(End end = Program);
    /// Stops the program, as SIGSTOP does, while frames arrive; or lets it run again.
    void setStopped(bool stopped);
    /// Sets the monotonic clock. Call this before start(), or after kill(): if the program runs,
    /// the call ends the test program with a message.
    /// \param offset  difference to QPlcSimulator::now()
    /// \param drift  by how many millionths the clock is fast (more than 0) or slow
    void setClock(std::chrono::nanoseconds offset, double drift);
    /// Steps the wall clock by \a step; the monotonic clock does not change.
    void stepWallClock(std::chrono::nanoseconds step);

private:
    friend class QPlcSimulator;

    /// A node that leaves its master before its own code ends.
    template<typename Node>
    struct Leaving : Node
    {
        using Node::Node;
        ~Leaving() override { this->disconnectFromMaster(); }
    };
    template<typename Type, typename... Arguments>
    static std::shared_ptr<Type> makeProgram(Arguments &&...arguments)
    {
        if constexpr (std::is_base_of_v<QPlcSlaveNode, Type> && !std::is_final_v<Type>)
            return std::make_shared<Leaving<Type>>(std::forward<Arguments>(arguments)...);
        else
            return std::make_shared<Type>(std::forward<Arguments>(arguments)...);
    }
    void startProgram(const std::type_info &type, const std::function<std::shared_ptr<void>()> &make);
    void *programOf(const std::type_info &type) const;

    std::unique_ptr<qplc::SimulatedHost> m_host;
    void *m_program = nullptr;
    const std::type_info *m_type = nullptr;  // of the program, if there is one
};
