// SPDX-License-Identifier: Apache-2.0
// Written by hand in the form of an export: a C++ class with functions for its inputs and outputs.
#ifndef RTW_HEADER_Servo_h_
#define RTW_HEADER_Servo_h_
#include "rtwtypes.h"

// Class declaration for model Servo
class Servo final
{
  // public data and function members
 public:
  // External inputs (root inport signals with default storage)
  struct ExtU_Servo_T {
    real_T target;                     // '<Root>/target'
  };

  // External outputs (root outports fed by signals with default storage)
  struct ExtY_Servo_T {
    real_T angle;                      // '<Root>/angle'
  };

  // Copy Constructor
  Servo(Servo const&) = delete;

  // Assignment Operator
  Servo& operator= (Servo const&) & = delete;

  // External inputs set method
  void setExternalInputs(const ExtU_Servo_T *pExtU_Servo_T)
  {
    Servo_U = *pExtU_Servo_T;
  }

  // External outputs get method
  const ExtY_Servo_T &getExternalOutputs() const
  {
    return Servo_Y;
  }

  // Initial conditions function
  void initialize();

  // model step function
  void step();

  // Constructor
  Servo();

  // Destructor
  ~Servo();

  // private data and function members
 private:
  // External inputs
  ExtU_Servo_T Servo_U;

  // External outputs
  ExtY_Servo_T Servo_Y;
  real_T m_angle;
};

#endif
