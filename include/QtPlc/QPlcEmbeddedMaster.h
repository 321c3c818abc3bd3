// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcMasterNode.h"

#include <QtCore/QStringList>

#include <chrono>
#include <functional>
#include <memory>
#include <utility>

/// A master inside of another program, which turns its clock: a co-simulation, a library that a
/// simulator loads, a test with nodes on the network. The program needs no event loop and no
/// QCoreApplication.
///
/// The object has a thread of its own, where a QPlcMasterNode with the clock QPlcClock::external()
/// handles the messages of nodes and tools. The program configures it with call(), and then calls
/// start(), step(), and stop(). It exchanges values by nodes of its own, whose ports it writes
/// before step() and reads after it, on the thread that calls step():
/// \code
/// class Command : public QPlcCompactSlaveNode
/// {
/// public:
///     Command() : QPlcCompactSlaveNode("Command") {}
///     QPlcOutput<double> speed{this, "tetherSpeed"};  // [m/s]
/// private:
///     void step(const QPlcCycle &) override {}  // the program writes the port
/// };
///
/// class Measurement : public QPlcCompactSlaveNode
/// {
/// public:
///     Measurement() : QPlcCompactSlaveNode("Measurement") {}
///     QPlcInput<double> length{this, "tetherLength"};  // [m]
/// private:
///     void step(const QPlcCycle &) override {}
/// };
///
/// int main()
/// {
///     const char *const table = "[tetherSpeed]\ntype = Real64\n[tetherLength]\ntype = Real64\n";
///     QPlcEmbeddedMaster master;
///     master.call([&](QPlcMasterNode &node) {
///         node.setSignalTable(QPlcSignalTable::fromIni(table));
///         node.startServer(QPlcUnderlyingProtocol::tcp(QHostAddress::LocalHost, 50000));
///     });
///     Command *command = master.addNode<Command>();
///     Measurement *measurement = master.addNode<Measurement>();
///     // The winch is a program of its own, which connects to port 50000.
///     if (!command || !measurement || !master.start(std::chrono::seconds(10), {"Winch"}))
///         return 1;  // master.errorString() says why
///     for (int cycle = 0; cycle < 1000; ++cycle) {
///         command->speed = measurement->length < 300.0 ? 2.0 : -2.0;
///         if (master.step() != QPlcMasterNode::StepResult::Complete)
///             break;
///     }
///     return 0;
/// }
/// \endcode
/// docs/delays.md says how many steps a value needs from the program to a node and back.
///
/// There may be several objects in a program, one after the other or at the same time. If there is
/// no QCoreApplication, the first object makes one in a thread of its own, and the last one ends
/// it: do not make another one meanwhile. The threads receive no signals of the operating system,
/// and the locale of the program stays as it is.
///
/// \threadsafe yes: each function may be called from any thread that is not the master's own, that
///     is, not inside of call(). step() lets one caller in at a time. The destructor needs that
///     nobody else uses the object any more
///
/// \ingroup master
class QTPLC_EXPORT QPlcEmbeddedMaster
{
public:
    /// Makes the thread and the master in it.
    QPlcEmbeddedMaster();
    /// Stops, and destroys the nodes of addNode(), the master, and the thread.
    ~QPlcEmbeddedMaster();
    QPlcEmbeddedMaster(const QPlcEmbeddedMaster &) = delete;
    QPlcEmbeddedMaster &operator=(const QPlcEmbeddedMaster &) = delete;

    /// Runs \a code in the thread of the master, and returns when it has returned. For all that
    /// QPlcMasterNode can do: signal table, period, server, nodes, values, events. Objects that \a
    /// code makes for the master live in this thread, and have to be destroyed there.
    /// \return false when \a code has thrown an exception: errorString() has its text
    bool call(const std::function<void(QPlcMasterNode &)> &code);
    /// Makes a node in the thread of the master and adds it (QPlcMasterNode::addLocalNode()). It
    /// lives as long as this object. Read and write its ports on the thread that calls step(),
    /// while no step is in progress.
    /// \return nullptr when the master refuses the node: errorString() says why
    template<typename Node, typename... Arguments>
    Node *addNode(Arguments &&...arguments)
    {
        std::shared_ptr<Node> node;
        const auto make
            = [&](QPlcMasterNode &) { node = std::make_shared<Node>(std::forward<Arguments>(arguments)...); };
        return call(make) && add(node) ? node.get() : nullptr;
    }

    /// Initializes all nodes: afterwards the ports of the nodes of addNode() have their initial
    /// values, and start() only has to begin. Waits before until all nodes are there that the
    /// manifest or \a nodes name. You may call it again before start(), for other initial values.
    /// \param longest  for all of it, 1 ms to 24 h
    /// \param nodes  names of remote nodes that have to be connected
    /// \return false when it was not possible in that time: errorString() says why, and which nodes
    ///     are missing
    bool initialize(std::chrono::milliseconds longest, const QStringList &nodes = {});
    /// Begins the real-time phase; the first step() is cycle 0. Waits before until all nodes are
    /// there that the manifest or \a nodes name, and initializes all nodes unless initialize() has
    /// done it.
    /// \param longest  for all of it, 1 ms to 24 h
    /// \param nodes  names of remote nodes that have to be connected
    /// \return false when it was not possible in that time: errorString() says why, and which nodes
    ///     are missing. Nothing runs then
    bool start(std::chrono::milliseconds longest, const QStringList &nodes = {});
    /// Computes one or more cycles on the calling thread; see QPlcMasterNode::step(). SafeStop,
    /// Stopped and Busy end it at once.
    /// \param periods  by which the time of the plant advances: 1 or more. Simulated time advances
    ///     in whole periods only
    /// \return the result of the last cycle; Late if one of them was late
    QPlcMasterNode::StepResult step(int periods = 1);
    /// Ends the real-time phase; a step in progress on another thread ends within 20 ms. In
    /// SafeStop it does nothing: use call() and QPlcMasterNode::reset().
    void stop();

    /// Returns the last error of this object or its master, as a sentence with the remedy; empty:
    /// there was none.
    QString errorString() const;

private:
    bool add(const std::shared_ptr<QPlcSlaveNode> &node);

    struct Q_DECL_HIDDEN Private;
    std::unique_ptr<Private> d;
};
