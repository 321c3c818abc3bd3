// SPDX-License-Identifier: Apache-2.0
// Written by hand in the form of an export: a C++ class with public inputs and outputs.
#ifndef RTW_HEADER_Counter_h_
#define RTW_HEADER_Counter_h_
#include "rtwtypes.h"

#ifndef rtmGetErrorStatus
#define rtmGetErrorStatus(rtm) ((rtm)->errorStatus)
#endif

// External inputs (root inport signals with default storage)
typedef struct {
  int32_T increment;                   // '<Root>/increment'
} ExtU_Counter_T;

// External outputs (root outports fed by signals with default storage)
typedef struct {
  int32_T count;                       // '<Root>/count'
} ExtY_Counter_T;

// Real-time Model Data Structure
struct tag_RTM_Counter_T {
  const char_T *errorStatus;
};

typedef struct tag_RTM_Counter_T RT_MODEL_Counter_T;

// Class declaration for model Counter
class CounterModelClass {
  // public data and function members
 public:
  // External inputs
  ExtU_Counter_T Counter_U;

  // External outputs
  ExtY_Counter_T Counter_Y;

  // model initialize function
  void initialize();

  // model step function
  void step();

  // Constructor
  CounterModelClass();

  // Destructor
  ~CounterModelClass();

  // Real-Time Model get method
  RT_MODEL_Counter_T * getRTM();

  // private data and function members
 private:
  int32_T m_count;
  RT_MODEL_Counter_T Counter_M;
};

#endif
