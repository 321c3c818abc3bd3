// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "FmiFunctions.h"
#include "FmuDescription.h"

#include <atomic>
#include <memory>

namespace qplc {

class FmuLog;

/// The library of an FMU and its one instance, as functions that are the same for both versions of
/// FMI. It calls; when a function may be called, its user has to know.
class FmuInstance
{
public:
    /// What a communication step has led to.
    struct Step
    {
        int status = fmi::Ok;
        bool needsEvent = false;  // FMI 3 with event mode
        bool isOver = false;      // the FMU ends the simulation
        bool isEarly = false;     // it has not done the whole step
        double lastTime = 0.0;    // [s] that the FMU has reached, with isEarly or isOver
    };
    struct Experiment
    {
        double startTime = 0.0;           // [s]
        std::optional<double> stopTime;   // [s]
        std::optional<double> tolerance;  // relative
    };

    /// Loads the library \a fileName. \return null, with a sentence in \a error, when it cannot be
    /// loaded, lacks functions, or follows another version
    static std::unique_ptr<FmuInstance> load(const FmuDescription &description, const QString &fileName,
                                             const std::shared_ptr<FmuLog> &log, QString *error);
    virtual ~FmuInstance();
    FmuInstance(const FmuInstance &) = delete;
    FmuInstance &operator=(const FmuInstance &) = delete;

    /// Uses event mode if the FMU has it; some that say so refuse it, and work without.
    /// \param resources  path of the folder of its resources
    /// \return false when the FMU refuses
    bool instantiate(const QString &resources, bool logs);
    bool exists() const { return m_instance != nullptr; }
    bool usesEventMode() const { return m_usesEventMode; }
    void free();
    /// Keeps \a instance until the process ends: after a fatal error none of its functions may be
    /// called, and threads of it may still run.
    static void abandon(std::unique_ptr<FmuInstance> instance) noexcept;

    virtual int enterInitializationMode(const Experiment &experiment) = 0;
    int exitInitializationMode() { return call(m_names->exitInitializationMode, m_exitInitializationMode); }
    int terminate() { return call(m_names->terminate, m_terminate); }
    int reset() { return call(m_names->reset, m_reset); }
    virtual int get(FmuVariable::Kind kind, const fmi::ValueReference *references, std::size_t count, void *values,
                    std::size_t valueCount)
        = 0;
    virtual int set(FmuVariable::Kind kind, const fmi::ValueReference *references, std::size_t count,
                    const void *values, std::size_t valueCount)
        = 0;
    int setText(fmi::ValueReference reference, const QString &text);
    virtual Step doStep(double time, double step) = 0;
    // FMI 3 with event mode.
    virtual int enterEventMode() { return fmi::Ok; }
    virtual int enterStepMode() { return fmi::Ok; }
    virtual int updateDiscreteStates(bool *needsUpdate, bool *isOver);

    /// Name of the function of an FMU that runs, or ran last; null: there was none.
    static const char *lastCall() { return s_call.load(std::memory_order_relaxed); }
    static bool isCalling() { return s_isInside.load(std::memory_order_relaxed); }
    /// Whether the calling thread is in it.
    static bool isCallingHere() { return s_isHere; }

protected:
    /// What functions that both versions have are called in one of them.
    struct Names
    {
        const char *version;
        const char *instantiate;
        const char *freeInstance;
        const char *exitInitializationMode;
        const char *terminate;
        const char *reset;
    };

    /// Marks that the FMU runs, for the message when it does not come back.
    class Call
    {
    public:
        explicit Call(const char *name)
        {
            s_call.store(name, std::memory_order_relaxed);
            s_isInside.store(true, std::memory_order_relaxed);
            s_isHere = true;
        }
        ~Call()
        {
            s_isInside.store(false, std::memory_order_relaxed);
            s_isHere = false;
        }
        Call(const Call &) = delete;
        Call &operator=(const Call &) = delete;
    };

    FmuInstance(const FmuDescription &description, const Names &names, const std::shared_ptr<FmuLog> &log);
    virtual bool loadFunctions(const FmuDescription &description) = 0;
    virtual fmi::Instance make(const QByteArray &name, const QByteArray &resources, bool logs) = 0;

    template<typename Function>
    void find(const char *name, Function *function)
    {
        *function = reinterpret_cast<Function>(symbol(name));
        if (!*function)
            m_missing << QString::fromLatin1(name);
    }
    void *symbol(const char *name) const;
    int call(const char *name, fmi::OfInstance function)
    {
        const Call inside(name);
        return function(m_instance);
    }

    const Names *m_names;
    const std::shared_ptr<FmuLog> m_log;
    QByteArray m_modelName;
    QByteArray m_token;
    bool m_usesEventMode;
    fmi::Instance m_instance = nullptr;
    fmi::OfInstance m_exitInitializationMode = nullptr;
    fmi::OfInstance m_terminate = nullptr;
    fmi::OfInstance m_reset = nullptr;

private:
    bool open(const QString &fileName, QString *error);
    bool check(const FmuDescription &description, QString *error);

    static std::atomic<const char *> s_call;
    static std::atomic<bool> s_isInside;
    static thread_local bool s_isHere;
    static std::atomic<FmuInstance *> s_abandoned;
    FmuInstance *m_next = nullptr;  // of those that are abandoned
    void *m_library = nullptr;
    fmi::Version m_version = nullptr;
    fmi::FreeInstance m_free = nullptr;
    QStringList m_missing;
};

}  // namespace qplc
