// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "ChildProcess.h"

#include <memory>
#include <vector>

namespace awe {

/// The programs of a flight: started together, ended together; none is left behind.
class ProcessGroup : public QObject
{
    Q_OBJECT
public:
    enum Errors {
        ShowErrors,  ///< what the program says on its standard error appears at once
        HoldErrors   ///< it appears when all have ended: until then the terminal shows something else
    };

    ~ProcessGroup() override;

    /// Starts a program that lies beside this one. \return null when it could not be started; the
    /// message is out then
    ChildProcess *start(const QString &program, const QStringList &arguments, Errors errors = ShowErrors);
    /// Asks the programs to end, in the order of their start, and makes those end that do not
    /// within \a milliseconds.
    void end(int milliseconds);

Q_SIGNALS:
    /// A program has ended without being asked to. \param exitCode  -1 when it crashed
    void ended(const QString &program, int exitCode);

private:
    std::vector<std::unique_ptr<ChildProcess>> m_processes;
};

}  // namespace awe
