// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcSimulator.h"
#include "QPlcSlaveNode.h"
#include "QPlcUnderlyingProtocol.h"

#include <memory>
#include <type_traits>
#include <utility>

namespace qplc {
class SimulatedHost;
}

/// A computer in a QPlcSimulator with one program on it: a master, a node or a tool.
///
/// All calls of the objects of a program belong into call(): there the thread is on this host, with
/// its clocks, its network and its random numbers. Functions that only return a value may be called
/// from outside.
///
/// \code
/// QPlcSimulatedHost winchHost(simulator, "winch");
/// Winch *winch = winchHost.start<Winch>();
/// winchHost.call([&] { winch->connectToMaster(masterHost.place()); });
/// simulator.runFor(std::chrono::seconds(10));
/// winchHost.kill();          // as with kill -9
/// winchHost.start<Winch>();  // the next life of the program
/// \endcode
///
/// \threadsafe no: as QPlcSimulator
class QPlcSimulatedHost
{
public:
    /// What becomes of the connections of a program that is killed.
    enum End {
        Program,  ///< the kernel of the host lives on and tells the other ends
        Power     ///< the other ends hear nothing
    };

    /// \param name  of the host; its random numbers follow from the seed and the name
    /// \pre fewer than 200 hosts
    QPlcSimulatedHost(QPlcSimulator &simulator, const QString &name);
    /// Kills the program, as without power.
    ~QPlcSimulatedHost();
    QPlcSimulatedHost(const QPlcSimulatedHost &) = delete;
    QPlcSimulatedHost &operator=(const QPlcSimulatedHost &) = delete;

    QString name() const;
    /// Returns where a master on this host listens, and where nodes find it: "sim://127.0.1.1:50000".
    QPlcUnderlyingProtocol place() const;

    /// Makes a \a Type(arguments ...) on this host, and kills what was there. The host owns it until
    /// kill().
    template<typename Type, typename... Arguments>
    Type *start(Arguments &&...arguments)
    {
        std::shared_ptr<Type> program;
        startProgram([&] { return program = makeProgram<Type>(std::forward<Arguments>(arguments)...); });
        return program.get();
    }
    /// Returns what start() has made. \pre it was a \a Type; null: nothing runs
    template<typename Type>
    Type *program() const
    {
        return static_cast<Type *>(m_program);
    }
    bool isRunning() const { return m_program; }
    /// Runs \a code on this host.
    void call(const std::function<void()> &code);

    /// Ends the program; nothing that its objects do as they end reaches the network.
    void kill(End end = Program);
    /// Lets the program stand still, as after SIGSTOP, while frames come in; or lets it go on.
    void setStopped(bool stopped);
    /// Sets the monotonic clock: \a offset from QPlcSimulator::now(), and by how many millionths it
    /// is fast (> 0) or slow. Call this before start().
    void setClock(std::chrono::nanoseconds offset, double drift);
    /// Steps the wall clock by \a step; the monotonic clock does not notice.
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
    void startProgram(const std::function<std::shared_ptr<void>()> &make);

    std::unique_ptr<qplc::SimulatedHost> m_host;
    void *m_program = nullptr;
};
