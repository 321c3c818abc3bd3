// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "FmuVariables.h"

#include <functional>
#include <string>

namespace qplc_export {

/// An instance of an FMU: what both standards have in common. Functions that fail tell the host why
/// and return false.
class FmuInstance
{
public:
    enum Phase : quint8 { Instantiated = 1, Initializing = 2, Stepping = 4, Terminated = 8, Failed = 16 };
    /// The host hears of Info only while logging is on.
    enum class Level : quint8 { Error, Warning, Discard, Notice, Info };
    enum class StepResult : quint8 { Complete, Warned, Failed };
    /// How the host wants to be told; not empty.
    using Log = std::function<void(Level level, const char *text)>;

    /// \return null when there can be no such instance
    static std::unique_ptr<FmuInstance> make(Standard standard, const char *instanceName, const char *token, Log log);

    void setLogging(bool isOn) { m_isLogging = isOn; }
    bool fail(const QString &text) const;
    /// Whether \a function may be called now. \param phases  in which it may, one or several
    bool allows(const char *function, int phases) const;

    bool setStart(double start);
    bool enterInitialization();
    bool exitInitialization();
    /// \param wantsStop  set when the node wants the simulation to end
    StepResult doStep(double time, double size, bool *wantsStop);
    void terminate();
    bool reset();
    double time() const;

    /// Null: there is no such variable.
    const FmuVariable *find(const char *function, unsigned reference) const;
    /// Only for a kind that \a function is for.
    const FmuVariable *find(const char *function, unsigned reference, FmuVariable::Kind kind) const;
    bool isSettable(const char *function, const FmuVariable &variable) const;
    bool setReal(const char *function, const FmuVariable &variable, double value);
    bool setInteger(const char *function, const FmuVariable &variable, qint64 value, int element = 0);
    bool setText(const char *function, const FmuVariable &variable, const char *text);
    /// Valid until the next call for this variable.
    const char *text(const FmuVariable &variable);
    QPlcNodeRunner &runner() { return m_node.runner(); }
    const QPlcNodeRunner &runner() const { return m_node.runner(); }

private:
    FmuInstance(Standard standard, Log log)
        : m_standard(standard)
        , m_log(std::move(log))
    {
    }
    void tell(Level level, const QString &text) const;
    bool isNow(double time) const;
    StepResult runCycles(qint64 count, bool *wantsStop);
    bool warnOfPlant();
    void warnOfRefusedInputs();

    const Standard m_standard;
    const Log m_log;
    bool m_isLogging = false;
    ExportedNode m_node;
    std::vector<FmuVariable> m_variables;
    std::vector<std::string> m_texts;  // of each variable
    std::vector<bool> m_isRefused;     // of each variable
    Phase m_phase = Instantiated;
    double m_start = 0.0;  // [s]
};

}  // namespace qplc_export
