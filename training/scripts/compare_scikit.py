"""Compares a learned pre-condition with scikit-learn's machines on the same samples.

    python3 compare_scikit.py DIR [CONTROLLER...]

Reads DIR/CONTROLLER.{train,test}.csv and DIR/CONTROLLER.report.json, of all controllers if none is named.
Run by hand; needs numpy and scikit-learn, on which nothing else depends.
"""

import csv
import json
import sys
from pathlib import Path

import numpy as np
from sklearn.metrics import accuracy_score, balanced_accuracy_score
from sklearn.model_selection import GridSearchCV, StratifiedKFold
from sklearn.svm import SVC

MOST_SAMPLES = 3000  # of the training set, for the choice of C and gamma


def read(path):
    """Feature names, rows and labels of a CSV whose last column is success."""
    with open(path, newline="") as file:
        lines = csv.reader(file)
        header = next(lines)
        values = np.array([[float(v) for v in line] for line in lines])
    if header[-1] != "success" or not len(values):
        sys.exit(f"{path}: the last column is no success, or there are no samples")
    return header[:-1], values[:, :-1], values[:, -1] == 1


def compare(folder, controller):
    """Prints the figures of the report and of scikit-learn's machines."""
    features, train, train_success = read(folder / f"{controller}.train.csv")
    test_features, test, test_success = read(folder / f"{controller}.test.csv")
    if features != test_features:
        sys.exit(f"{controller}: the two sets have different columns")

    mean, scale = train.mean(axis=0), train.std(axis=0)
    scale[scale <= 1e-12 * np.abs(mean)] = 1
    train, test = (train - mean) / scale, (test - mean) / scale

    print(f"{controller:24}{'accuracy':>10}{'balanced':>10}")
    report = json.loads((folder / f"{controller}.report.json").read_text())
    svm, neighbour = report["svm"], report["nn"]
    for name, found in [(f"report: {svm['kernel']}", svm), ("report: neighbour", neighbour)]:
        print(f"{name:24}{found['accuracy']:10.4f}{found['balanced_accuracy']:10.4f}")

    folds = StratifiedKFold(4, shuffle=True, random_state=report["seed"] % 2**32)
    # Large gammas take polynomials hours.
    for name, kernel, gammas in [
        ("rbf", {"kernel": "rbf"}, (0.3, 1, 3, 10)),
        ("poly2", {"kernel": "poly", "degree": 2, "coef0": 1}, (0.3, 1, 3)),
        ("poly3", {"kernel": "poly", "degree": 3, "coef0": 1}, (0.3, 1, 3)),
    ]:
        grid = {"C": [0.3, 1, 3, 10, 30, 100], "gamma": [f / len(features) for f in gammas]}
        machine = SVC(class_weight="balanced", **kernel)
        search = GridSearchCV(machine, grid, scoring="balanced_accuracy", cv=folds, refit=False)
        search.fit(train[:MOST_SAMPLES], train_success[:MOST_SAMPLES])
        machine.set_params(**search.best_params_).fit(train, train_success)
        foretold = machine.predict(test)
        accuracy = accuracy_score(test_success, foretold)
        balanced = balanced_accuracy_score(test_success, foretold)
        chosen = ", ".join(f"{k} {v:.3g}" for k, v in search.best_params_.items())
        print(f"{'scikit-learn: ' + name:24}{accuracy:10.4f}{balanced:10.4f}  {chosen}", flush=True)


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    folder = Path(sys.argv[1])
    there = sorted(path.name.removesuffix(".report.json") for path in folder.glob("*.report.json"))
    for controller in sys.argv[2:] or there:
        compare(folder, controller)


if __name__ == "__main__":
    main()
