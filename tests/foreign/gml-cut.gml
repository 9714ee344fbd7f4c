graph
[
  Creator "Gephi"
  directed 0
  node
  [
    id 0
    label "0"
    graphics
    [
      x 0.5
      y -1.25E-4
      w 10.0
      fill "#c0c0c0"
    ]
  ]
  node
  [
    id 1
    label "1"
    graphics
    [
      x 1.5
      y -1.25E-4
      w 10.0
      fill "#c0c0c0"
    ]
  ]
  node
  [
    id 2
    label "2"
    graphics
    [
      x 2.5
      y -1.25E-4
      w 10.0
      fill "#c0c0c0"
    ]
  ]
  node
  [
    id 3
    label "3"
    graphics
    [
      x 3.5
      y -1.25E-4
      w 10.0
      fill "#c0c0c0"
    ]
  ]
  node
  [
    id 4
    label "4"
    graphics
    [
      x 4.5
      y -1.25E-4
      w 10.0
      fill "#c0c0c0"
    ]
  ]
  node
  [
    id 5
    label "5"
    graphics
    [
      x 5.5
      y -1.25E-4
      w 10.0
      fill "#c0c0c0"
    ]
  ]
  node
  [
    id 6
    label "6"
    graphics
    [
      x 6.5
      y -1.25E-4
      w 10.0
      fill