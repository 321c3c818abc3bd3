// SPDX-License-Identifier: Apache-2.0
// soak_node: a node of the soak's plant, as a process.
#include "SoakNode.h"

int main(int argc, char **argv)
{
    QPlcNodeApplication application(argc, argv);
    soak::addNodeOptions(application);
    soak::NodeOptions options;
    soak::HistoryFile history;
    if (!application.parseNodeOptions() || !soak::readNodeOptions(application, &options, &history))
        return application.exitCode();
    soak::SoakNode node(options, history);
    history.append(soak::Record::Born, options.node, {quint64(application.applicationPid())});
    return application.run(node);
}
