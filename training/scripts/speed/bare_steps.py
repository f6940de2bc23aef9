#!/usr/bin/env python3
"""Times bare steps of MuJoCo on request: `bare_steps.py MODEL.xml`.

Prints a line of JSON when it is ready: {"version", "dt"}. After that each line of stdin is a number of
steps; it answers with the CPU time that these took, s. The character stands under position servos; it
has settled for 1 s, and every request begins at the same state. The loop over the steps is in C.
"""
import json
import sys
import time

import mujoco
import numpy as np

SETTLED = 1000
# Steps from one return to the same state to the next.
LAP = 5000


def ready(path):
    model = mujoco.MjModel.from_xml_path(path)
    model.opt.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
    model.opt.cone = mujoco.mjtCone.mjCONE_PYRAMIDAL
    model.opt.solver = mujoco.mjtSolver.mjSOL_NEWTON
    model.opt.iterations = 100
    model.opt.ls_iterations = 50
    model.opt.tolerance = 1e-8
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, 0)
    mujoco.mj_step(model, data, SETTLED)
    return model, data


def main():
    model, data = ready(sys.argv[1])
    kind = mujoco.mjtState.mjSTATE_INTEGRATION
    settled = np.zeros(mujoco.mj_stateSize(model, kind))
    mujoco.mj_getState(model, data, settled, kind)
    print(json.dumps({"version": mujoco.__version__, "dt": model.opt.timestep}), flush=True)
    for line in sys.stdin:
        left, took = int(line), 0.0
        while left > 0:
            steps = min(left, LAP)
            mujoco.mj_setState(model, data, settled, kind)
            mujoco.mj_forward(model, data)
            begun = time.process_time()
            mujoco.mj_step(model, data, steps)
            took += time.process_time() - begun
            left -= steps
        print(took, flush=True)


if __name__ == "__main__":
    main()
